// SPDX-License-Identifier: MIT
// The manual page (man(7) macros) and the completion of a program's words, from the same table as
// --help.
#include "options/manual.h"

#include "base/version.h"
#include "options/table.h"

#include <ctype.h>
#include <string.h>

// ORDER program
static const struct {
    const char *summary, *synopsis, *description, *files, *others;
} pages[] = {
    {"render POV-Ray scenes with bicubic patches natively",
     "[\\fIswitches\\fR] \\fIscene.pov\\fR | \\fIscene.qi.json\\fR",
     "Renders a scene as povray(1) does, but meets each bicubic patch itself, with the\n"
     "quasi-interpolating control net, instead of triangles. Its switches, INI files and "
     "animations\n"
     "are POV-Ray's; a word with two dashes is its own. What a scene holds and this program does "
     "not\n"
     "model is warned of, with its place.\n",
     ".TP\n.I picture.png.qi-state\nThe finished tiles of a render of more than a second, until "
     "the "
     "picture is there; see\n.BR \\-\\-continue .\n.TP\n.I povray.ini\nRead as POV-Ray reads it: "
     "$POVINI, the "
     "working folder, ~/.povray/3.7, /etc/povray/3.7.\n",
     ".BR pov2qi (1),\n.BR qicompare (1),\n.BR qibench (1),\n.BR povray (1)\n"},
    {"convert POV-Ray scenes to the scene file of qirender",
     "[\\fIswitches\\fR] \\fIscene.pov\\fR [\\fB\\-o\\fR \\fIscene.qi.json\\fR]",
     "Runs the program that a POV-Ray scene is, and writes what it describes as JSON. Silent when "
     "all\n"
     "is well; an error names file, line and column and shows the line.\n",
     ".TP\n.I scene.qi.bin\nLarge arrays of numbers beside scene.qi.json, with\n.B "
     "\\-\\-binary\nand "
     "always above 10,000 patches.\n",
     ".BR qirender (1),\n.BR povray (1)\n"},
    {"show how far the pictures of POV-Ray and qirender differ",
     "[\\fIswitches\\fR] [\\fIlimits\\fR] [\\fB\\-o\\fR \\fIfolder\\fR] \\fIscene.pov\\fR ... | "
     "\\fIone.png\\fR \\fItwo.png\\fR",
     "Renders each scene with povray(1) and with qirender(1) at the same switches, or takes two\n"
     "pictures; prints the figures that idiff(1) prints and writes a page with both pictures, a "
     "map of\n"
     "the differences, and the worst places with the reason of each.\n",
     ".TP\n.I folder/index.html\nThe page; of several scenes, the table over their pages.\n",
     ".BR qirender (1),\n.BR idiff (1),\n.BR povray (1)\n"},
    {"measure rays against patches, and what accuracy costs",
     "\\fBtrace\\fR [\\fIoptions\\fR] \\fIfile\\fR | \\fBspeed\\fR [\\fIoptions\\fR] "
     "\\fBmethods\\fR|\\fBpicture\\fR|\\fBlattices\\fR|\\fBthreads\\fR ... | "
     "\\fBsweep\\fR [\\fIoptions\\fR] \\fIscene.pov\\fR ...",
     ".B trace\nanswers rays against bicubic patches. Its file is text: `patches N', then 16 lines "
     "`x y z' a\npatch; `rays M', then M lines `ox oy oz dx dy dz'. One line a ray: `t u v patch "
     "bound' of the\nnearest hit (t in lengths of the direction, patches counted from 0), or "
     "`miss'. A hit within its\nbound of the ray's origin is the surface that the ray leaves, and "
     "is not reported.\n.PP\n.B speed\nmeasures rays against the teapot of POV-Ray's examples, in "
     "turn with Embree's triangles where Embree\nis installed, and prints tables in "
     "Markdown.\n.PP\n.B sweep\nrenders each scene by every method at several tolerances, with "
     "POV-Ray's triangles cut more and\nmore, and by povray(1) itself, and prints what each costs "
     "and how far it is from the truth, which\nis qi at 1e-14.\n",
     ".TP\n.I folder/index.html\nOf\n.BR \\-\\-html :\nthe page; sweep.csv and sweep.json have "
     "its figures.\n",
     ".BR qirender (1),\n.BR qicompare (1),\n.BR povray (1)\n"},
};

// Text for roff: no line may begin with a dot or a quote, dashes and backslashes are escaped.
static void put_text(FILE *out, const char *text) {
    if (*text == '.' || *text == '\'')
        fputs("\\&", out);
    for (; *text; text++) {
        if (*text == '-' || *text == '\\')
            putc('\\', out);
        if (*text == '\\')
            putc('e', out);
        else
            putc(*text, out);
    }
}

static void put_form(FILE *out, const char *before, const char *word, const char *gap,
                     const char *value) {
    fputs("\\fB", out);
    put_text(out, before);
    put_text(out, word);
    fputs("\\fR", out);
    if (value) {
        fputs(gap, out);
        fputs("\\fI", out);
        put_text(out, value);
        fputs("\\fR", out);
    }
}

static void put_row(FILE *out, const OptionRow *row) {
    const char *comma = "";
    fputs(".TP\n", out);
    if (row->letters) {
        put_form(out, "+", row->letters, "", row->value);
        comma = ", ";
    }
    if (row->word) {
        fputs(comma, out);
        put_form(out, "--", row->word, " ", row->value);
        comma = ", ";
    }
    if (row->keyword) {
        fputs(comma, out);
        put_form(out, "", row->keyword, "=", row->value ? row->value : "on|off");
    }
    putc('\n', out);
    put_text(out, row->help);
    putc('\n', out);
}

static bool is_shown(const OptionRow *row, OptionsProgram program) {
    return row->kind != OPTION_HEADING && row->help && (row->programs & (1u << program));
}

void options_manual(OptionsProgram program, FILE *out) {
    const char *name = option_program_name(program);
    fprintf(out, ".\\\" Made by %s --man.\n.TH ", name);
    for (const char *c = name; *c; c++)
        putc(toupper((unsigned char)*c), out);
    fprintf(out, " 1 \"\" \"qipov %s\" \"User Commands\"\n", QIPOV_VERSION);
    fprintf(out, ".SH NAME\n%s \\- %s\n.SH SYNOPSIS\n.B %s\n%s\n.SH DESCRIPTION\n%s", name,
            pages[program].summary, name, pages[program].synopsis, pages[program].description);
    if (program != PROGRAM_QIBENCH)
        fputs(".PP\nThe value is glued to its switch: +W640. Keyword=value is the form of INI "
              "files, and "
              "works on the\ncommand line too. Later words win.\n",
              out);
    const OptionRow *heading = NULL;
    for (size_t i = 0; i < option_row_count; i++) {
        const OptionRow *row = &option_rows[i];
        if (row->kind == OPTION_HEADING)
            heading = row;
        if (!is_shown(row, program))
            continue;
        if (heading)
            fprintf(out, ".SH %s\n", heading->help);
        heading = NULL;
        put_row(out, row);
    }
    fprintf(out,
            ".SH EXIT STATUS\n.TP\n0\ndone\n.TP\n1\nwrong input%s\n.TP\n2\nwrong usage or "
            "interrupted\n.SH FILES\n%s.SH SEE ALSO\n%s",
            program == PROGRAM_QICOMPARE ? ", or differences over the limits" : "",
            pages[program].files, pages[program].others);
}

void options_completion(OptionsProgram program, FILE *out) {
    const char *name = option_program_name(program);
    fprintf(out, "# bash completion, made by %s --completion\n_%s() {\n", name, name);
    fputs("    local word=${COMP_WORDS[COMP_CWORD]}\n    case $word in\n    -*)\n        "
          "COMPREPLY=($(compgen -W '",
          out);
    for (size_t i = 0; i < option_row_count; i++)
        if (is_shown(&option_rows[i], program) && option_rows[i].word)
            fprintf(out, "--%s ", option_rows[i].word);
    fputs("' -- \"$word\"));;\n    +*)\n        COMPREPLY=($(compgen -W '", out);
    for (size_t i = 0; i < option_row_count; i++)
        if (is_shown(&option_rows[i], program) && option_rows[i].letters)
            fprintf(out, "+%s ", option_rows[i].letters);
    fprintf(
        out,
        "' -- \"$word\"));;\n    *)\n        COMPREPLY=($(compgen -f -X '!*.@(pov|json|ini%s)' -- "
        "\"$word\") $(compgen -d -S / -- \"$word\"));;\n    esac\n}\n"
        "shopt -s extglob\ncomplete -o nospace -F _%s %s\n",
        program == PROGRAM_QICOMPARE ? "|png|exr|tif|tga"
        : program == PROGRAM_QIBENCH ? "|txt"
                                     : "",
        name, name);
}
