// SPDX-License-Identifier: MIT
// Light that a body breaks up by its colour. The spectrum from 380 to 730 nm is cut into as many
// bands as the body has samples; each is refracted by an index of its own, and what it sees is
// tinted by the band's hue. The hues of all bands add up to white.
//
// The hues are POV-Ray's: parabolas over the spectrum, sampled every 5 nm from 375 to 740, summed
// up so that a band takes the difference of two sums, the sums scaled to end at 1 and kept with
// four decimals.
#include "render/shading.h"

#include <math.h>

static const double VIOLET = 380.0, RED = 730.0;
static const double BASE = 375.0, STEP = 5.0;

static double arch(double high, double width, double peak, double x) {
    double d = width * (x - peak);
    return fmax(0.0, high - d * d);
}

void dispersion_prepare(Shading *shading) {
    double sums[DISPERSION_HUES][3] = {{0}};
    for (int i = 1; i < DISPERSION_HUES; i++) {
        double x = 0.03 + 0.934 * i / (DISPERSION_HUES - 1);
        double r = arch(1.15, 5.0, 0.75, x); // with a small second one at the violet end
        sums[i][0] = sums[i - 1][0] + (r > 0.0 ? r : arch(0.12, 4.0, 0.12, x));
        sums[i][1] = sums[i - 1][1] + arch(1.1, 4.5, 0.57, x);
        sums[i][2] = sums[i - 1][2] + arch(1.0, 4.0, 0.28, x);
    }
    const double *all = sums[DISPERSION_HUES - 1];
    for (int i = 0; i < DISPERSION_HUES; i++)
        shading->hues[i] = rgb((float)(round(sums[i][0] / all[0] * 1e4) / 1e4),
                               (float)(round(sums[i][1] / all[1] * 1e4) / 1e4),
                               (float)(round(sums[i][2] / all[2] * 1e4) / 1e4));
}

static Rgb hue_sum(const Shading *shading, double wavelength) {
    double at = fmin(fmax((wavelength - BASE) / STEP, 0.0), DISPERSION_HUES - 1.0);
    int i = (int)at < DISPERSION_HUES - 2 ? (int)at : DISPERSION_HUES - 2;
    at -= i;
    return rgb_add(rgb_scale(shading->hues[i], 1.0 - at), rgb_scale(shading->hues[i + 1], at));
}

Band dispersion_band(const Shading *shading, int index, int count) {
    Band band = {.wavelength =
                     (float)(VIOLET + (RED - VIOLET) * (((float)index + 0.5) / (float)count))};
    float width = (float)((RED - VIOLET) / (float)count);
    Rgb low = hue_sum(shading, band.wavelength - width / 2.0f);
    Rgb high = hue_sum(shading, band.wavelength + width / 2.0f);
    Rgb part = rgb(high.r - low.r, high.g - low.g, high.b - low.b);
    band.hue = rgb_scale(part, (RED - VIOLET) / width);
    return band;
}

double dispersion_ratio(double ratio, double dispersion, float wavelength) {
    return ratio * pow(dispersion, -(wavelength - (VIOLET + RED) / 2.0) / (RED - VIOLET));
}
