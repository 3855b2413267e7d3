// SPDX-License-Identifier: MIT
// What a picture of a random tree shows, worked out pixel by pixel from where its solids are: all
// roots along the ray in long double, of which those count that the membership of all other parts
// lets through. Shares no code with the renderer.
#ifndef TESTS_CSG_ORACLE_H
#define TESTS_CSG_ORACLE_H

#include "tests/csg_tree.h"

typedef struct CsgOracle CsgOracle;

// The scene that the picture must be of, but for the tree itself.
extern const char CSG_ORACLE_SCENE[];

// Everything in arena; the tree must outlive it.
CsgOracle *csg_oracle_create(const CsgTree *tree, Arena *arena);
// r g b, linear, of the middle of a pixel; y counts from the top.
void csg_oracle_pixel(CsgOracle *oracle, int x, int y, int width, int height, double rgb[3]);

#endif
