// SPDX-License-Identifier: MIT
// Fractal sums of noise (Musgrave's). The last argument is the noise generator, modulo 4.
#include "function/internal.h"

#include "noise/noise.h"

static int generator_of(double v) { return noise_int(v) & 3; }

static double signed_noise(Vec3 v, int generator) { return noise_value(v, generator) * 2.0 - 1.0; }

// One more round of a loop, if the budget has one.
static int may_go_on(const InternalContext *context) {
    if (*context->budget == 0)
        return 0;
    --*context->budget;
    return 1;
}

// H, lacunarity, octaves, offset, gain, generator.
INTERNAL(f_hetero_mf) {
    const double *q = p + 3;
    Vec3 v = vec3(p[0], p[1], p[2]);
    int generator = generator_of(q[5]), power = noise_int(q[4]);
    double signal = signed_noise(v, generator) + q[3];
    v = vec_scale(v, q[1]);
    double step = pow(q[1], -q[0]), weight = step;
    for (int i = 1; i < q[2] && may_go_on(context); i++) {
        double more = (signed_noise(v, generator) + q[3]) * weight;
        // Times the signal so far, `power` times over.
        for (int k = power; k > 0 && may_go_on(context); k--)
            more *= signal;
        signal += more;
        v = vec_scale(v, q[1]);
        weight *= step;
    }
    double rest = q[2] - noise_int(q[2]);
    if (rest != 0.0)
        signal += rest * ((signed_noise(v, generator) + q[3]) * weight) * signal;
    return signal;
}

// Lambda, octaves, omega, offset, ridge, generator.
INTERNAL(f_ridge) {
    const double *q = p + 3;
    Vec3 v = vec3(p[0], p[1], p[2]);
    int generator = generator_of(q[5]), octaves = noise_int(q[1]);
    double lambda = q[0], omega = q[2], offset = q[3], ridge = q[4];
    double ridge_scale = 1.0 / internal_max(ridge, 1.0 - ridge);
    double scale = 1.0 / internal_max(offset, 1.0 - offset), rest = q[1] - (double)octaves;
    double value = fabs(noise_value(v, generator) - ridge) * ridge_scale - offset, total = 1.0;
    for (int i = 2; i <= octaves && may_go_on(context); i++) {
        double n = fabs(noise_value(vec_scale(v, lambda), generator) - ridge) * ridge_scale;
        value += omega * (n - offset);
        total += omega;
        lambda *= q[0];
        omega *= q[2];
    }
    if (rest != 0.0) {
        double n = fabs(noise_value(vec_scale(v, lambda), generator) - ridge) * ridge_scale;
        value += omega * (n - offset) * rest;
        total += omega * rest;
    }
    return value * scale / total;
}

static double ridged_signal(Vec3 v, int generator, double offset) {
    double signal = offset - fabs(signed_noise(v, generator));
    return signal * signal;
}

// H, lacunarity, octaves, offset, gain, generator. POV-Ray works out the weights of the octaves
// once, from the H and lacunarity of the first call in the scene; here each call has its own.
INTERNAL(f_ridged_mf) {
    const double *q = p + 3;
    Vec3 v = vec3(p[0], p[1], p[2]);
    int generator = generator_of(q[5]);
    double signal = ridged_signal(v, generator, q[3]), result = signal, frequency = 1.0;
    for (int i = 1; i < q[2] && may_go_on(context); i++) {
        v = vec_scale(v, q[1]);
        frequency *= q[1];
        double weight = signal * q[4];
        weight = weight > 1.0 ? 1.0 : weight;
        weight = weight < 0.0 ? 0.0 : weight;
        signal = ridged_signal(v, generator, q[3]);
        signal *= weight;
        result += signal * pow(frequency, -q[0]);
    }
    return result;
}

INTERNAL(f_noise3d) { return noise_value(vec3(p[0], p[1], p[2]), context->noise_generator); }

INTERNAL(f_noise_generator) { return noise_value(vec3(p[0], p[1], p[2]), generator_of(p[3])); }
