// SPDX-License-Identifier: MIT
// Growing arrays: ARRAY(Type) declares a struct { items, count, capacity }; zeroed is empty. The
// elements live in the heap until array_free; finished arrays are copied once into an arena.
#ifndef BASE_ARRAY_H
#define BASE_ARRAY_H

#include <stddef.h>

#define ARRAY(Type)                                                                                \
    struct {                                                                                       \
        Type *items;                                                                               \
        size_t count, capacity;                                                                    \
    }

// Appends value; evaluates the array expression several times.
#define array_push(array, value)                                                                   \
    (((array)->count == (array)->capacity                                                          \
          ? (void)((array)->items =                                                                \
                       array_grow((array)->items, &(array)->capacity, sizeof *(array)->items))     \
          : (void)0),                                                                              \
     (array)->items[(array)->count++] = (value))

#define array_free(array)                                                                          \
    (array_release((array)->items), (array)->items = NULL, (array)->count = (array)->capacity = 0)

// Doubles *capacity (at least to 1, or 16 in a release build); dies when memory is out.
void *array_grow(void *items, size_t *capacity, size_t item_size);
void array_release(void *items);

#endif
