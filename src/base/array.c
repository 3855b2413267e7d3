// SPDX-License-Identifier: MIT
#include "base/array.h"

#include "base/diag.h"

#include <stdint.h>
#include <stdlib.h>

#ifdef HOSTILE
enum { FIRST_CAPACITY = 1 };
#else
enum { FIRST_CAPACITY = 16 };
#endif

void *array_grow(void *items, size_t *capacity, size_t item_size) {
    size_t wanted = *capacity ? *capacity * 2 : FIRST_CAPACITY;
    if (wanted > SIZE_MAX / 2 / item_size)
        die("out of memory (%zu elements of %zu bytes wanted)", wanted, item_size);
    void *grown = realloc(items, wanted * item_size);
    if (!grown)
        die("out of memory (%zu bytes wanted)", wanted * item_size);
    *capacity = wanted;
    return grown;
}

void array_release(void *items) { free(items); }
