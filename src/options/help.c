// SPDX-License-Identifier: MIT
// The text of --help, from the table: switch, INI form or word, and what it does, in two columns.
#include "options/manual.h"
#include "options/table.h"

#include "base/version.h"

#include <stdio.h>
#include <string.h>

enum { LEFT = 34, WIDTH = 100 };

// Prints text from column LEFT on, broken at blanks.
static void print_wrapped(const char *text) {
    int column = LEFT;
    for (bool first = true; *text; first = false) {
        int word = (int)strcspn(text, " ");
        if (!first && column + 1 + word > WIDTH) {
            printf("\n%*s", LEFT, "");
            column = LEFT;
        } else if (!first) {
            putchar(' ');
            column++;
        }
        printf("%.*s", word, text);
        column += word;
        text += word;
        text += strspn(text, " ");
    }
    putchar('\n');
}

static void print_row(const OptionRow *row) {
    char left[LEFT + 40];
    const char *value = row->value ? row->value : "";
    int at = 0;
    if (row->letters)
        at = snprintf(left, sizeof left, "  +%s%s", row->letters, value);
    if (row->word)
        at += snprintf(left + at, sizeof left - (size_t)at, "%s--%s %s", at ? ", " : "  ",
                       row->word, value);
    if (row->keyword && !row->word)
        at += snprintf(left + at, sizeof left - (size_t)at, "%s%s=%s", at ? ", " : "  ",
                       row->keyword, row->letters ? "" : value);
    printf("%s", left);
    if (at >= LEFT)
        printf("\n%*s", LEFT, "");
    else
        printf("%*s", LEFT - at, "");
    print_wrapped(row->help);
}

static void print_help(OptionsProgram program) {
    // ORDER program
    static const char *const usage[] = {
        "usage: qirender [switches] scene.pov | scene.qi.json\n"
        "Renders a scene with bicubic patches, natively. Switches are POV-Ray's.\n",
        "usage: pov2qi [switches] scene.pov [-o scene.qi.json]\n"
        "Converts a POV-Ray scene to the scene file of qirender.\n",
        "usage: qicompare [switches] [limits] [-o folder/] scene.pov [-- more switches]\n"
        "       qicompare [limits] [-o folder/] one.png two.png\n"
        "Renders a scene with povray and with qirender at the same switches, or takes two "
        "pictures;\n"
        "prints how far they differ and writes a page that shows it. --method, --tolerance, "
        "--strict\n"
        "and other words with two dashes go to qirender only.\n",
        "usage: qibench trace [options] FILE\n"
        "       qibench speed [options] methods | picture | lattices | threads ...\n"
        "       qibench sweep [options] scene.pov ...\n"
        "trace: the nearest hits of the rays in FILE. speed: rays against the teapot, in tables. "
        "sweep:\n"
        "what accuracy costs in whole scenes. The manual page has more (qibench --man | man -l "
        "-).\n",
    };
    printf("%s", usage[program]);
    const OptionRow *heading = NULL;
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (row->kind == OPTION_HEADING)
            heading = row;
        else if (row->help && (row->programs & (1u << program))) {
            if (heading)
                printf("\n%s\n", heading->help);
            heading = NULL;
            print_row(row);
        }
    }
    if (program == PROGRAM_QIBENCH) {
        printf("\nExit status: 0 done, 1 wrong input, 2 wrong usage or interrupted.\n");
        return;
    }
    printf("\nThe value is glued to its switch: +W640. Keyword=value works for all of POV-Ray's\n"
           "keywords of these switches. Later words win. Exit status: 0 done, 1 wrong input%s,\n"
           "2 wrong usage or interrupted.\n",
           program == PROGRAM_QICOMPARE ? " or differences over the limits" : "");
}

bool options_inform(OptionsProgram program, const RenderOptions *options) {
    if (options->help)
        print_help(program);
    else if (options->show_version)
        printf("%s %s\n", option_program_name(program), QIPOV_VERSION);
    else if (options->manual)
        options_manual(program, stdout);
    else if (options->completion)
        options_completion(program, stdout);
    else
        return false;
    return true;
}
