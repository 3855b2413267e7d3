// SPDX-License-Identifier: MIT
// Documentation that is made from the table of options.
#ifndef OPTIONS_MANUAL_H
#define OPTIONS_MANUAL_H

#include "options/options.h"

#include <stdio.h>

void options_manual(OptionsProgram program, FILE *out);     // the manual page, for man(1)
void options_completion(OptionsProgram program, FILE *out); // a script for bash

#endif
