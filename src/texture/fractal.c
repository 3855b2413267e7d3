// SPDX-License-Identifier: MIT
// Mandelbrot's and Julia's sets and those of magnets (facts: textures 2.5): how soon, or where, a
// point of the plane leaves. Powers are written out as POV-Ray has them, since the last bit of a
// step decides after many of them.
#include "texture/formula.h"

#include <math.h>

static double exterior_value(const FractalShape *f, int round, double a, double b) {
    double factor = f->exterior_factor;
    unsigned modulus;
    switch (f->exterior) {
    case 0:
        return factor;
    case 1:
        return (double)round / (double)f->iterations;
    case 2:
        return a * factor;
    case 3:
        return b * factor;
    case 4:
        return a * a * factor;
    case 5:
        return b * b * factor;
    case 6:
        return sqrt(a * a + b * b) * factor;
    default: // 7 and 8
        factor += f->exterior - 7;
        modulus = factor >= 1.0 && factor < 4294967296.0 ? (unsigned)factor : 1u;
        return (double)((unsigned)round % modulus) / f->exterior_factor;
    }
}

static double interior_value(const FractalShape *f, double a, double b, double nearest) {
    double factor = f->interior_factor;
    switch (f->interior) {
    case 0:
        return factor;
    case 1:
        return sqrt(nearest) * factor;
    case 2:
        return a * factor;
    case 3:
        return b * factor;
    case 4:
        return a * a * factor;
    case 5:
        return b * b * factor;
    default:
        return a * a + b * b * factor;
    }
}

// (a + b i)^exponent by the binomial formula.
static void power(double *a, double *b, int exponent) {
    double x = *a, y = *b, real = pow(x, exponent), imaginary = 0.0, binomial[34];
    binomial[0] = 1.0;
    for (int k = 1; k <= exponent; k++)
        binomial[k] = binomial[k - 1] * (exponent + 1 - k) / k; // whole at each step
    for (int k = 2; k <= exponent; k += 2)
        real += (k & 2 ? -binomial[k] : binomial[k]) * pow(x, exponent - k) * pow(y, k);
    for (int k = 1; k <= exponent; k += 2)
        imaginary += (k & 2 ? -binomial[k] : binomial[k]) * pow(x, exponent - k) * pow(y, k);
    *a = real;
    *b = imaginary;
}

static void step(double *a, double *b, int exponent, double cr, double ci) {
    double x = *a, y = *b, x2 = x * x, y2 = y * y;
    switch (exponent) {
    case 2:
        *b = 2.0 * x * y + ci;
        *a = x2 - y2 + cr;
        break;
    case 3:
        *b = 3.0 * x2 * y - y2 * y + ci;
        *a = x2 * x - 3.0 * x * y2 + cr;
        break;
    case 4:
        *b = 4.0 * (x2 * x * y - x * y2 * y) + ci;
        *a = x2 * x2 - 6.0 * x2 * y2 + y2 * y2 + cr;
        break;
    default:
        power(a, b, exponent);
        *a += cr;
        *b += ci;
        break;
    }
}

static double polynomial(const FractalShape *f, Vec3 p, double cr, double ci) {
    double a = p.x, b = p.y, nearest = a * a + b * b;
    for (int round = 0; round < f->iterations; round++) {
        step(&a, &b, f->exponent, cr, ci);
        double distance = a * a + b * b;
        if (distance < nearest)
            nearest = distance;
        if (distance > 4.0)
            return exterior_value(f, round, a, b);
    }
    return interior_value(f, a, b, nearest);
}

// The quotient of the magnet's two polynomials, squared.
static void magnet_step(double *a, double *b, int magnet, double cr, double ci) {
    double x = *a, y = *b, x2 = x * x, y2 = y * y, nr, ni, dr, di;
    if (magnet == 1) {
        nr = x2 - y2 + cr - 1;
        ni = 2 * x * y + ci;
        dr = 2 * x + cr - 2;
        di = 2 * y + ci;
    } else {
        double c1 = cr - 1, c2 = cr - 2, k = c1 * c2 - ci * ci, l = (c1 + c2) * ci;
        nr = x2 * x - 3 * x * y2 + 3 * (x * c1 - y * ci) + k;
        ni = 3 * x2 * y - y2 * y + 3 * (x * ci + y * c1) + l;
        dr = 3 * (x2 - y2) + 3 * (x * c2 - y * ci) + k + 1;
        di = 6 * x * y + 3 * (x * ci + y * c2) + l;
    }
    double size = dr * dr + di * di, qr = (nr * dr + ni * di) / size,
           qi = (ni * dr - nr * di) / size;
    *b = 2 * qr * qi;
    *a = qr * qr - qi * qi;
}

static double magnet(const FractalShape *f, double a, double b, double nearest, double cr,
                     double ci) {
    for (int round = 0; round < f->iterations; round++) {
        magnet_step(&a, &b, f->magnet, cr, ci);
        double distance = a * a + b * b, from_1 = a - 1;
        if (distance < nearest)
            nearest = distance;
        if (distance > 10000.0 || from_1 * from_1 + b * b < 1 / 10000.0)
            return exterior_value(f, round, a, b);
    }
    return interior_value(f, a, b, nearest);
}

double fractal_value(const Pattern *pattern, Vec3 p) {
    const FractalShape *f = &pattern->fractal;
    bool julia = f->julia;
    double cr = julia ? f->c.u : p.x, ci = julia ? f->c.v : p.y;
    if (f->magnet == 0)
        return polynomial(f, p, cr, ci);
    if (julia)
        return magnet(f, p.x, p.y, p.x * p.x + p.y * p.y, cr, ci);
    return magnet(f, 0.0, 0.0, 10000.0, cr, ci);
}
