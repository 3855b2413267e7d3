// SPDX-License-Identifier: MIT
// qicompare: how far two pictures differ, in figures and as a page. Given a scene, it renders it
// first, with povray and with the qirender beside it, at the same switches.
#include "base/diag.h"
#include "base/file.h"
#include "base/progress.h"
#include "base/version.h"
#include "options/animation.h"
#include "options/options.h"
#include "report/compare_page.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

// ---- commands
// -------------------------------------------------------------------------------------

// The words of a command; the last is NULL.
typedef struct {
    const char **words;
    size_t count;
} Command;

static void add(Command *command, const char *word) { command->words[command->count++] = word; }

// The words as a shell would have to be given them.
static const char *command_text(Arena *arena, const Command *command) {
    const char *plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+-=_./:,@%";
    char *text = arena_strdup(arena, "");
    for (size_t i = 0; i < command->count; i++) {
        const char *word = command->words[i], *gap = i ? " " : "";
        if (*word && !word[strspn(word, plain)]) {
            text = arena_printf(arena, "%s%s%s", text, gap, word);
            continue;
        }
        text = arena_printf(arena, "%s%s'", text, gap);
        for (; *word; word++)
            text = arena_printf(arena, *word == '\'' ? "%s'\\'%c'" : "%s%c", text, *word);
        text = arena_printf(arena, "%s'", text);
    }
    return text;
}

// The end of a log: its last lines, which say what went wrong.
static const char *tail(const char *text) {
    enum { LINES = 12 };
    const char *at = text + strlen(text);
    for (int lines = 0; at > text && lines <= LINES; at--)
        lines += at[-1] == '\n';
    return at > text ? at + 1 : text;
}

static double user_seconds(const struct rusage *use) {
    return (double)use->ru_utime.tv_sec + 1e-6 * (double)use->ru_utime.tv_usec;
}

// Runs the command with both its outputs in the file `log`, waits, and notes times and words. Dies
// if it cannot be run or fails; status 2 when it was interrupted.
static void render_with(Command *command, const char *log, CompareSide *side, Arena *arena) {
    command->words[command->count] = NULL;
    side->command = command_text(arena, command);
    double start = progress_seconds();
    fflush(NULL);
    pid_t child = fork();
    if (child < 0)
        die("cannot start %s: %s", command->words[0], strerror(errno));
    if (child == 0) {
        int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666),
            none = open("/dev/null", O_RDONLY);
        if (file >= 0 && none >= 0 && dup2(none, 0) == 0 && dup2(file, 1) == 1 &&
            dup2(file, 2) == 2)
            execvp(command->words[0], (char *const *)(uintptr_t)command->words);
        _exit(127);
    }
    int status;
    struct rusage use;
    while (wait4(child, &status, 0, &use) < 0)
        if (errno != EINTR)
            die("cannot wait for %s: %s", command->words[0], strerror(errno));
    side->elapsed = progress_seconds() - start;
    side->seconds = user_seconds(&use);
    const char *said = file_read(arena, log, NULL, NULL);
    side->log = said ? said : "";
    if (WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) == 2))
        die("%s was interrupted or misused:\n%s\n%s", side->name, side->command, tail(side->log));
    if (WEXITSTATUS(status) == 127)
        die("%s could not be run; is it installed?\n%s", side->name, side->command);
    if (status != 0)
        die("%s failed:\n%s\n%s", side->name, side->command, tail(side->log));
}

// The qirender that stands beside this program.
static const char *find_qirender(Arena *arena) {
    char own[4096];
    ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    if (length < 0)
        die("cannot find the folder of this program: %s", strerror(errno));
    own[length] = '\0';
    char *slash = strrchr(own, '/');
    const char *path = arena_printf(arena, "%.*s/qirender", (int)(slash - own), own);
    if (access(path, X_OK) != 0)
        die("cannot run '%s': %s", path, strerror(errno));
    return path;
}

static const char *machine_name(Arena *arena) {
    const char *text = file_read(arena, "/proc/cpuinfo", NULL, NULL);
    const char *model = text ? strstr(text, "model name") : NULL;
    const char *colon = model ? strchr(model, ':') : NULL;
    long cores = sysconf(_SC_NPROCESSORS_ONLN);
    if (!colon)
        return arena_printf(arena, "%ld cores", cores);
    return arena_printf(arena, "%.*s, %ld core%s", (int)strcspn(colon + 2, "\n"), colon + 2, cores,
                        cores == 1 ? "" : "s");
}

// Both renderers get the same words; qirender those with two dashes as well.
static void render_both(const RenderOptions *o, const char *folder, ComparePage *page,
                        Arena *arena) {
    const char *extension = image_extension(o->format);
    const char *program[2] = {"povray", find_qirender(arena)};
    static const char *const names[2] = {"POV-Ray", "qirender"};
    const char *slash = strrchr(o->input, '/');
    // POV-Ray looks for includes in the working directory, not beside the scene.
    const char *library =
        slash ? arena_printf(arena, "+L%.*s", (int)(slash - o->input) + 1, o->input) : "+L.";
    for (int i = 0; i < 2; i++) {
        CompareSide *side = &page->side[i];
        side->name = names[i];
        const char *picture =
            arena_printf(arena, "%s/%s.%s", folder, i ? "qirender" : "povray", extension);
        Command command = {ARENA_ARRAY(arena, const char *, o->shared_count + o->own_count + 10),
                           0};
        add(&command, program[i]);
        for (size_t k = 0; k < o->shared_count; k++)
            add(&command, o->shared[k]);
        add(&command, library);
        for (size_t k = 0; i == 1 && k < o->own_count; k++)
            add(&command, o->own[k]);
        // Last: an INI file among the words may name another picture.
        add(&command, arena_printf(arena, "+I%s", o->input));
        add(&command, arena_printf(arena, "+O%s", picture));
        add(&command, arena_printf(arena, "+W%d", o->width));
        add(&command, arena_printf(arena, "+H%d", o->height));
        add(&command, "-D");
        add(&command, "-P");
        if (o->verbose)
            fprintf(stderr, "%s ...\n", names[i]);
        unlink(picture); // what is read below must be new
        render_with(&command, arena_printf(arena, "%s/%s.txt", folder, i ? "qirender" : "povray"),
                    side, arena);
        side->image = image_read(arena, picture);
    }
    page->title = o->input;
    page->machine = machine_name(arena);
}

static void read_both(const RenderOptions *o, ComparePage *page, Arena *arena) {
    for (int i = 0; i < 2; i++) {
        page->side[i].name = o->pictures[i];
        page->side[i].seconds = -1;
        page->side[i].image = image_read(arena, o->pictures[i]);
    }
    page->title = arena_printf(arena, "%s and %s", o->pictures[0], o->pictures[1]);
}

// ---- results
// --------------------------------------------------------------------------------------

static void print_limit(uint64_t count, uint64_t pixels, double limit) {
    printf("  %llu pixels (%.3g%%) over %g\n", (unsigned long long)count,
           100.0 * (double)count / (double)pixels, limit);
}

// In the words and the order of idiff.
static void print_figures(const ComparePage *page, const RenderOptions *o) {
    const ImageDifference *d = &page->difference;
    printf("Comparing \"%s\" and \"%s\"\n", page->side[0].name, page->side[1].name);
    if (d->max > 0) {
        printf("  Mean error = %.6g\n  RMS error = %.6g\n  Peak SNR = %.4g\n", d->mean, d->rms,
               d->psnr);
        printf("  Max error  = %.6g @ (%d, %d, channel %d)\n", d->max, d->max_x, d->max_y,
               d->max_channel);
        printf("  %llu pixels (%.3g%%) off by more than one step of 8 bits\n",
               (unsigned long long)d->different, 100.0 * (double)d->different / (double)d->pixels);
        print_limit(d->warned, d->pixels, o->warn);
        print_limit(d->failed, d->pixels, o->fail);
    }
    if (page->side[0].seconds >= 0)
        printf("  User seconds: %s %.2f, %s %.2f\n", page->side[0].name, page->side[0].seconds,
               page->side[1].name, page->side[1].seconds);
    printf("%s\n", page->verdict);
}

static const char *judge(const ImageDifference *d, const RenderOptions *o) {
    double share = 100.0 / (double)d->pixels;
    if ((double)d->failed * share > o->fail_percent)
        return "FAILURE";
    return (double)d->warned * share > o->warn_percent ? "WARNING" : "PASS";
}

// The folder for pictures and page: what -o says, made if need be, or a new temporary one.
static const char *output_folder(const RenderOptions *o, Arena *arena) {
    if (o->output) {
        char *folder = arena_strdup(arena, o->output);
        size_t length = strlen(folder);
        while (length > 1 && folder[length - 1] == '/')
            folder[--length] = '\0';
        if (mkdir(folder, 0777) != 0 && errno != EEXIST)
            die("cannot make the folder '%s': %s", folder, strerror(errno));
        struct stat st;
        if (stat(folder, &st) != 0 || !S_ISDIR(st.st_mode))
            die("'%s' is not a folder", folder);
        return folder;
    }
    const char *base = getenv("TMPDIR");
    char *folder = arena_printf(arena, "%s/qicompare-XXXXXX", base && *base ? base : "/tmp");
    if (!mkdtemp(folder))
        die("cannot make a temporary folder '%s': %s", folder, strerror(errno));
    return folder;
}

static int usage(const char *why) {
    fprintf(stderr, "qicompare: error: %s (try qicompare --help)\n", why);
    return 2;
}

static int check_words(const RenderOptions *o) {
    if (o->input && o->picture_count)
        return usage("give a scene or two pictures, not both");
    if (!o->input && o->picture_count != 2)
        return usage("a scene or two pictures are needed");
    size_t length = o->input ? strlen(o->input) : 0;
    if (length > 5 && strcmp(o->input + length - 5, ".json") == 0)
        return usage("POV-Ray must render it too, so the scene must be a .pov");
    Animation animation;
    if (animation_of(o, &animation))
        return usage("an animation is compared frame by frame: give its clock with +K");
    if (!o->output_to_file)
        return usage("-F writes no picture, so there is nothing to compare");
    if (o->output && (!*o->output || strcmp(o->output, "-") == 0))
        return usage("-o names a folder");
    return 0;
}

static void on_interrupt(int number) {
    (void)number;
    _exit(2);
}

int main(int argc, char **argv) {
    diag_program("qicompare");
    signal(SIGINT, on_interrupt);
    signal(SIGTERM, on_interrupt);
    Arena *arena = arena_create();
    RenderOptions options = options_default();
    options_read_povray_ini(PROGRAM_QICOMPARE, arena, &options);
    if (!options_parse(PROGRAM_QICOMPARE, argc, argv, arena, &options))
        return 2;
    if (options.help) {
        options_help(PROGRAM_QICOMPARE);
        return 0;
    }
    if (options.show_version) {
        puts("qicompare " QIPOV_VERSION);
        return 0;
    }
    if (check_words(&options) != 0)
        return 2;
    options.input = options_input_path(&options, arena);
    if (options.input && !file_exists(options.input))
        die("cannot read '%s': no such file", options.input);

    // Two pictures alone need no folder; a scene always does.
    ComparePage page = {.fail = options.fail, .fail_percent = options.fail_percent};
    const char *folder = options.output || options.input ? output_folder(&options, arena) : NULL;
    if (options.input)
        render_both(&options, folder, &page, arena);
    else
        read_both(&options, &page, arena);
    page.difference =
        image_compare(page.side[0].image, page.side[1].image, options.fail, options.warn);
    page.verdict = judge(&page.difference, &options);

    print_figures(&page, &options);
    if (folder) {
        const char *path = arena_printf(arena, "%s/index.html", folder);
        compare_page_write(&page, path);
        printf("%s\n", path);
    }
    bool failed = strcmp(page.verdict, "FAILURE") == 0;
    arena_destroy(arena);
    return failed ? 1 : 0;
}
