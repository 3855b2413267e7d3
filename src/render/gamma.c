// SPDX-License-Identifier: MIT
// All in float with powf, as the 16-bit files of POV-Ray show. A power law clips what is negative;
// the sRGB curve continues its straight piece.
#include "render/gamma.h"

#include <math.h>

static bool is_neutral_exponent(float exponent) { return fabs(1.0 - (double)exponent) <= 0.01; }

static Curve curve_exponent(float exponent) {
    if (is_neutral_exponent(exponent))
        return (Curve){.type = CURVE_NEUTRAL, .exponent = 1.0f};
    return (Curve){.type = CURVE_POWER, .exponent = exponent};
}

Curve curve_power(float gamma) { return curve_exponent(1.0f / gamma); }

Curve curve_srgb(void) { return (Curve){.type = CURVE_SRGB, .exponent = 1.0f}; }

Curve curve_working(const Settings *settings) {
    if (settings->gamma_mode == GAMMA_SRGB)
        return curve_srgb();
    return curve_power(settings->gamma_mode == GAMMA_POWER ? settings->assumed_gamma : 1.0f);
}

Transfer transfer_between(Curve working, Curve encoded) {
    const Curve neutral = curve_power(1.0f);
    if (working.type == CURVE_NEUTRAL)
        return (Transfer){neutral, encoded};
    if (working.type == CURVE_SRGB && encoded.type == CURVE_SRGB)
        return (Transfer){neutral, neutral};
    if (working.type == CURVE_POWER && encoded.type == CURVE_POWER) {
        if (is_neutral_exponent(working.exponent / encoded.exponent))
            return (Transfer){neutral, neutral};
        return (Transfer){neutral,
                          curve_exponent((1.0f / working.exponent) / (1.0f / encoded.exponent))};
    }
    if (working.type == CURVE_POWER && encoded.type == CURVE_NEUTRAL)
        return (Transfer){neutral, curve_exponent(1.0f / working.exponent)};
    return (Transfer){working, encoded};
}

static float positive(float x) { return x > 0.0f ? x : 0.0f; }

static float decode(const Curve *curve, float x) {
    switch (curve->type) {
    case CURVE_POWER:
        return powf(positive(x), 1.0f / curve->exponent);
    case CURVE_SRGB:
        return x < 0.04045f ? x / 12.92f : powf((x + 0.055f) / 1.055f, 2.4f);
    case CURVE_NEUTRAL:
        break;
    }
    return x;
}

static float encode(const Curve *curve, float x) {
    switch (curve->type) {
    case CURVE_POWER:
        return powf(positive(x), curve->exponent);
    case CURVE_SRGB:
        return x <= 0.0031308f ? x * 12.92f : 1.055f * powf(x, 1.0f / 2.4f) - 0.055f;
    case CURVE_NEUTRAL:
        break;
    }
    return x;
}

float transfer_apply(const Transfer *transfer, float x) {
    return encode(&transfer->encoded, decode(&transfer->working, x));
}

float transfer_undo(const Transfer *transfer, float x) {
    return encode(&transfer->working, decode(&transfer->encoded, x));
}
