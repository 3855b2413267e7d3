// SPDX-License-Identifier: MIT
// Rays are read in batches; of a batch each thread takes pieces, traces them and writes their text
// into the piece's own room; the batch's text goes out in order.
#include "bench/trace.h"

#include "base/diag.h"
#include "base/progress.h"

#include <errno.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

enum {
    PIECE = 256,
    PIECES = 256,
    BATCH = PIECE * PIECES,
    // Four numbers of at most 24 characters ("-1.2345678901234567e-300"), a count of at most 10,
    // and five blanks or line ends; snprintf wants room for a NUL as well.
    LINE = 4 * 24 + 10 + 5 + 1,
};

typedef struct {
    char text[PIECE * LINE];
    size_t length;
} PieceText;

static void trace_piece(const PatchSet *set, const Ray *rays, size_t count, PieceText *out) {
    out->length = 0;
    for (size_t i = 0; i < count; i++) {
        PatchHit hit;
        char *at = out->text + out->length;
        int length;
        if (patchset_intersect_leaving(set, &rays[i], INFINITY, UINT32_MAX, NULL, &hit))
            length = snprintf(at, LINE, "%.17g %.17g %.17g %u %.17g\n", hit.t, hit.u, hit.v, hit.id,
                              hit.bound);
        else
            length = snprintf(at, LINE, "miss\n");
        out->length += (size_t)length;
    }
}

void trace_rays(RayFile *file, const PatchSet *set, int threads, FILE *out) {
    Arena *arena = arena_create();
    Ray *rays = ARENA_ARRAY(arena, Ray, BATCH);
    PieceText *texts = ARENA_ARRAY(arena, PieceText, PIECES);
    size_t count;
    // On a terminal the answers themselves are the progress.
    Progress progress = progress_begin("tracing", ray_file_ray_count(file), !isatty(fileno(out)));
    while ((count = ray_file_next(file, rays, BATCH)) > 0) {
        int pieces = (int)((count + PIECE - 1) / PIECE);
#pragma omp parallel for schedule(dynamic) num_threads(threads)
        for (int i = 0; i < pieces; i++) {
            size_t first = (size_t)i * PIECE, left = count - first;
            trace_piece(set, rays + first, left < PIECE ? left : PIECE, &texts[i]);
        }
        for (int i = 0; i < pieces; i++)
            fwrite(texts[i].text, 1, texts[i].length, out);
        progress_add(&progress, count);
    }
    progress_end(&progress);
    if (fflush(out) != 0 || ferror(out))
        die("cannot write the hits: %s", strerror(errno));
    arena_destroy(arena);
}
