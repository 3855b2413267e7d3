// SPDX-License-Identifier: MIT
// How a value becomes an integer of a file.
#ifndef IMAGE_STORED_H
#define IMAGE_STORED_H

// The stored value, in `stored` bits, of k / (2^bits - 1): its bits from the top, repeated
// downwards. Clipped to 0..1; NaN is 0.
static inline unsigned image_stored(float value, int bits, int stored) {
    float clipped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    float scaled = clipped * (float)((1u << bits) - 1u);
    unsigned k = (unsigned)scaled;
    k += scaled - (float)k >= 0.5f; // the difference is exact: lroundf without the call
    if (bits >= stored)
        return k >> (bits - stored);
    unsigned out = 0;
    for (int place = stored - bits; place > -bits; place -= bits)
        out |= place >= 0 ? k << place : k >> -place;
    return out & ((1u << stored) - 1u);
}

#endif
