// SPDX-License-Identifier: MIT
#include "model/function.h"

#include "model/scene.h"

Function function_default(FunctionType type) {
    Function f = {.type = type, .parameters = 3, .pigment = NO_INDEX};
    f.transform = transform_identity();
    f.spline.width = 2;
    if (type == FUNCTION_SPLINE)
        f.parameters = 1;
    return f;
}

int function_internal_arguments(int number) {
    // x, y, z and their own (facts: sdl 2.7)
    static const unsigned char counts[FUNCTION_INTERNAL_COUNT] = {
        8, 8, 8, 8, 5, 5, 8, 7, 5, 4, 7, 4, 4, 4,  4, 9, 9, 6, 4, 7, 6, 9, 4, 4,  13, 10, 10,
        4, 4, 9, 4, 6, 7, 6, 9, 4, 4, 7, 4, 9, 8,  4, 4, 4, 7, 4, 6, 3, 4, 4, 10, 8,  9,  4,
        4, 4, 6, 3, 9, 9, 7, 4, 8, 7, 9, 4, 7, 10, 5, 3, 5, 6, 4, 4, 5, 9, 3, 3,  4,
    };
    return number >= 0 && number < FUNCTION_INTERNAL_COUNT ? counts[number] : 0;
}

int function_width(const Function *function) {
    switch (function->type) {
    case FUNCTION_PIGMENT:
        return FUNCTION_WIDTH;
    case FUNCTION_TRANSFORM:
        return 3;
    case FUNCTION_SPLINE:
        return function->spline.width;
    case FUNCTION_FORMULA:
    case FUNCTION_PATTERN:
        break;
    }
    return 1;
}
