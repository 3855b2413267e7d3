// SPDX-License-Identifier: MIT
// Primitives against POV-Ray's own pictures: each scene holds one object that paints its normal (as
// the slope pattern sees it), then its hit point, then its texture coordinates; the same rays are
// cast here and the same formulas applied. A pixel differs when one of the two sees a hit and the
// other does not, or when a channel is off by more than two steps of 16 bits.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "tests/povray_pictures.h"
#include "shape/shape.h"

#include <stdio.h>

enum { WIDTH = 64, HEIGHT = 48, CHANNELS = 3, PIXELS = WIDTH * HEIGHT };

typedef enum { PAINT_NORMAL, PAINT_POINT, PAINT_UV, PAINT_COUNT } Paint;

// Points are painted as (coordinate + 10) / 20.
static const double POINT_RANGE = 20.0;

// Half a step of rounding and two of float arithmetic, in steps of 16 bits.
static const double SLACK = 2.5;

static PovrayPictures *pictures;

static const char *const PAINTS[PAINT_COUNT] = {
    "#declare Out = texture { pigment { average pigment_map {"
    " [1 slope x color_map { [0 rgb 0] [1 rgb <3,0,0>] }]"
    " [1 slope y color_map { [0 rgb 0] [1 rgb <0,3,0>] }]"
    " [1 slope z color_map { [0 rgb 0] [1 rgb <0,0,3>] }] } } }\n"
    "#declare In = texture { pigment { average pigment_map {"
    " [1 slope x color_map { [0 rgb <3,0,0>] [1 rgb 0] }]"
    " [1 slope y color_map { [0 rgb <0,3,0>] [1 rgb 0] }]"
    " [1 slope z color_map { [0 rgb <0,0,3>] [1 rgb 0] }] } } }\n",
    "#declare Out = texture { pigment { average pigment_map {"
    " [1 gradient x color_map { [0 rgb 0] [1 rgb <3,0,0>] }]"
    " [1 gradient y color_map { [0 rgb 0] [1 rgb <0,3,0>] }]"
    " [1 gradient z color_map { [0 rgb 0] [1 rgb <0,0,3>] }] }"
    " scale 20 translate -10 } }\n#declare In = Out;\n",
    "#declare Out = texture { uv_mapping pigment { average pigment_map {"
    " [1 gradient x color_map { [0 rgb 0] [1 rgb <2,0,0>] }]"
    " [1 gradient y color_map { [0 rgb 0] [1 rgb <0,2,0>] }] } scale 20 translate -10 } }\n"
    "#declare In = Out;\n",
};

typedef struct {
    Vec3 location, direction, right, up;
    bool parallel; // orthographic
} View;

typedef struct {
    const char *name, *text; // text: the object without its closing brace
    Object object;
} Case;

typedef struct {
    size_t hits, differ;
    size_t edges; // pixels that differ but lie on an edge, see on_edge
} Tally;

// One picture: what stands where, seen from where, painted how.
typedef struct {
    const Case *test;
    const View *view;
    const Transform *transform; // or NULL
    Paint paint;
} Job;

static void write_scene(const Job *job, size_t number) {
    char path[128];
    snprintf(path, sizeof path, "%s/job%zu.pov", pictures->directory, number);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file,
            "#version 3.7; global_settings { assumed_gamma 1 ambient_light 1 }\n"
            "#default { finish { ambient 1 diffuse 0 } }\n%s",
            PAINTS[job->paint]);
    const Vec3 *v[4] = {&job->view->location, &job->view->direction, &job->view->right,
                        &job->view->up};
    const char *names[4] = {"location", "direction", "right", "up"};
    fprintf(file, "camera {%s\n", job->view->parallel ? " orthographic" : "");
    for (int i = 0; i < 4; i++)
        fprintf(file, "%s <%.17g, %.17g, %.17g>\n", names[i], v[i]->x, v[i]->y, v[i]->z);
    fprintf(file, "}\n%s", job->test->text);
    if (job->transform) {
        fprintf(file, " matrix <");
        for (int i = 0; i < 12; i++)
            fprintf(file, "%s%.17g", i ? "," : "", job->transform->m[i / 3][i % 3]);
        fprintf(file, ">");
    }
    // After the transform: what is painted is the hit in the world, not in the object's own space.
    fprintf(file, " texture { Out } interior_texture { In } }\n");
    fclose(file);
}

static Ray ray_through(const View *view, int x, int y) {
    double a = (x + 0.5) / WIDTH - 0.5, b = ((HEIGHT - 1) - (y - 0.5)) / HEIGHT - 0.5;
    Vec3 across = vec_add(vec_scale(view->right, a), vec_scale(view->up, b));
    if (view->parallel)
        return (Ray){vec_add(view->location, across), vec_normalize(view->direction)};
    return (Ray){view->location, vec_normalize(vec_add(view->direction, across))};
}

static double slope_value(double n) {
    n = n > 1.0 ? 1.0 : n < -1.0 ? -1.0 : n;
    return (asin(n) * 2.0 / M_PI + 1.0) / 2.0;
}

static double fraction(double x) { return x - floor(x); }

// What the pixel must be; false where the ray misses.
static bool expect(const Shape *shape, const Ray *ray, Paint paint, double rgb[CHANNELS],
                   double *reach) {
    ShapeHit hits[SHAPE_MAX_HITS], best = {.t = INFINITY};
    int count = shape_hits(shape, ray, hits);
    for (int i = count - 1; i >= 0; i--) {
        assert_true(isfinite(hits[i].t));
        if (hits[i].t >= 1e-4 && hits[i].t < best.t)
            best = hits[i];
    }
    if (!(best.t < INFINITY))
        return false;
    Vec3 p = vec_madd(ray->org, best.t, ray->dir);
    Vec3 n = shape_normal(shape, p, &best);
    Vec2 uv = shape_uv(shape, p, &best);
    *reach = paint == PAINT_NORMAL ? 0.0 : vec_length(p);
    bool inside = vec_dot(n, ray->dir) > 0.0;
    if (inside)
        n = vec_neg(n);
    for (int i = 0; i < CHANNELS; i++) {
        double v = slope_value(vec_get(n, i));
        if (paint == PAINT_NORMAL)
            rgb[i] = inside ? 1.0 - v : v;
        else if (paint == PAINT_POINT)
            rgb[i] = fraction((vec_get(p, i) + POINT_RANGE / 2) / POINT_RANGE);
        else
            rgb[i] = i == 2 ? 0.0 : fraction(((i ? uv.v : uv.u) + POINT_RANGE / 2) / POINT_RANGE);
    }
    return true;
}

// Does a ray moved by less than a millionth see something else? There POV-Ray's answer is the
// rounding of its float bounding boxes and of its turned frames, or of a root about to vanish.
static bool on_edge(const Shape *shape, const Ray *ray, Paint paint, const View *view) {
    double middle[CHANNELS], moved[CHANNELS], reach;
    bool hit = expect(shape, ray, paint, middle, &reach);
    for (int k = 0; k < 9; k++) {
        Vec3 shift = vec_add(vec_scale(view->right, (k % 3 - 1) * 0x1p-23),
                             vec_scale(view->up, (k / 3 - 1) * 0x1p-23));
        Ray near = {vec_add(ray->org, shift), ray->dir};
        if (expect(shape, &near, paint, moved, &reach) != hit)
            return true;
        for (int c = 0; c < CHANNELS && hit; c++)
            if (fabs(moved[c] - middle[c]) > 1e-3)
                return true;
    }
    return false;
}

static void compare(const Job *job, size_t number, Tally *tally) {
    const uint16_t *pixels = povray_read(pictures, number);
    if (!pixels)
        fail_msg("povray refused %s/job%zu.pov", pictures->directory, number);
    Arena *arena = arena_create();
    Object object = job->test->object;
    object.has_transform = job->transform != NULL;
    if (job->transform)
        object.transform = *job->transform;
    Shape shape = shape_prepare(NULL, &object, NULL, arena);
    for (int i = 0; i < PIXELS; i++) {
        Ray ray = ray_through(job->view, i % WIDTH, i / WIDTH);
        double rgb[CHANNELS] = {0, 0, 0}, reach = 0.0;
        const uint16_t *seen = pixels + i * CHANNELS;
        bool hit = expect(&shape, &ray, job->paint, rgb, &reach);
        bool same = hit == (seen[0] || seen[1] || seen[2]);
        // Paint that runs into 1 wraps to 0. Far out on a plane only the normal is compared: there
        // the picture shows the single precision of the pattern's value (coordinate / POINT_RANGE).
        for (int c = 0; c < CHANNELS && same && reach < 10.0 * POINT_RANGE; c++) {
            double off = fabs(rgb[c] * 65535.0 - seen[c]);
            same = off <= SLACK || off >= 65535.0 - SLACK;
        }
        tally->hits += hit;
        if (!same && on_edge(&shape, &ray, job->paint, job->view)) {
            tally->edges++;
            continue;
        }
        tally->differ += !same;
        if (!same)
            print_message("%s paint %d pixel %d,%d: %.2f %.2f %.2f, POV-Ray %d %d %d\n",
                          job->test->name, (int)job->paint, i % WIDTH, i / WIDTH, rgb[0] * 65535,
                          rgb[1] * 65535, rgb[2] * 65535, seen[0], seen[1], seen[2]);
    }
    arena_destroy(arena);
}

// From in front, from above at an angle, and from within.
static const View VIEWS[] = {
    {{0.05, 0.03, -4}, {0, 0, 1}, {1.3, 0, 0}, {0, 0.975, 0}, false},
    {{0.3, 2.9, -2.2}, {-0.08, -0.79, 0.6}, {1.6, 0, 0.2}, {0, 0.75, 0.98}, false},
    {{0.11, 0.07, 0.05}, {0.3, 0.2, 0.9}, {3.3, 0, -1.1}, {-0.1, 2.4, -0.6}, false},
};

// Rays parallel to an axis whose other two coordinates are multiples of 1/8: they run along faces,
// through edges, corners, rims and tips exactly.
static const View GRIDS[] = {
    {{0.0625, 0.0625, -4}, {0, 0, 1}, {8, 0, 0}, {0, 6, 0}, true},
    {{0.0625, 4, 0.0625}, {0, -1, 0}, {8, 0, 0}, {0, 0, 6}, true},
    {{-4, 0.0625, 0.0625}, {1, 0, 0}, {0, 0, 8}, {0, 6, 0}, true},
};

static void transforms(Transform out[3]) {
    Transform turn = transform_rotate(vec3(20, 35, -50)), s = transform_scale(vec3(0.7, 1.2, 0.9));
    Transform mirror = transform_scale(vec3(-1, 0.8, 1.1)),
              move = transform_translate(vec3(0.1, -0.05, 0.15));
    out[0] = transform_compose(&s, &turn);
    out[1] = transform_compose(&mirror, &turn);
    out[1] = transform_compose(&out[1], &move);
    // A shear.
    const double rows[4][3] = {{1, 0.3, 0}, {-0.2, 0.9, 0.4}, {0.1, 0, 0.8}, {0.02, 0.1, -0.1}};
    assert_true(transform_matrix(rows, &out[2]));
}

static void render_jobs(const Job *jobs, size_t job_count) {
    for (size_t i = 0; i < job_count; i++)
        write_scene(&jobs[i], i);
    if (!povray_render(pictures, job_count)) {
        print_message("povray is not installed: nothing to compare with\n");
        skip();
    }
}

// Compares the pictures [first, end), all of one case, and prints how many pixels differ.
static void compare_jobs(const Job *jobs, size_t first, size_t end, size_t edges_allowed) {
    Tally tallies[PAINT_COUNT] = {{0, 0, 0}};
    for (size_t i = first; i < end; i++)
        compare(&jobs[i], i, &tallies[jobs[i].paint]);
    static const char *const names[PAINT_COUNT] = {"normals", "points", "uv"};
    for (Paint paint = 0; paint < PAINT_COUNT; paint++) {
        const Tally *tally = &tallies[paint];
        if (tally->hits > 0)
            print_message("%s%s, %s: %zu of %zu pixels differ, and %zu on edges\n",
                          jobs[first].test->name, jobs[first].view->parallel ? " on a grid" : "",
                          names[paint], tally->differ, tally->hits, tally->edges);
        assert_int_equal(tally->differ, 0);
        assert_true(tally->edges <= edges_allowed);
    }
    assert_true(tallies[PAINT_NORMAL].hits > 30);
}

static void check(const Case *test) {
    Transform list[3];
    int count = test->object.type == OBJECT_PLANE || test->object.type == OBJECT_TRIANGLE ? 0 : 3;
    transforms(list);
    Job jobs[PAINT_COUNT * 6];
    size_t job_count = 0;
    // Untransformed from everywhere, each transform from one place.
    for (Paint paint = 0; paint < PAINT_COUNT; paint++)
        for (int t = -1; t < count; t++)
            for (int v = 0; v < 3; v++)
                if (t < 0 || v == t)
                    jobs[job_count++] = (Job){test, &VIEWS[v], t < 0 ? NULL : &list[t], paint};
    render_jobs(jobs, job_count);
    compare_jobs(jobs, 0, job_count, 0);
}

// Sphere and box agree on their edges too.
static void check_grid(const Case *cases, size_t count) {
    enum { PER_CASE = 6, MOST = 5 };
    Job jobs[PER_CASE * MOST];
    assert_true(count <= MOST);
    for (size_t i = 0; i < count * PER_CASE; i++)
        jobs[i] = (Job){&cases[i / PER_CASE], &GRIDS[i % 3], NULL,
                        i % PER_CASE < 3 ? PAINT_NORMAL : PAINT_POINT};
    render_jobs(jobs, count * PER_CASE);
    for (size_t i = 0; i < count; i++) {
        ObjectType type = cases[i].object.type;
        bool exact = type == OBJECT_SPHERE || type == OBJECT_BOX;
        compare_jobs(jobs, i * PER_CASE, (i + 1) * PER_CASE, exact ? 0 : PIXELS / 10);
    }
}

static Case make(const char *name, const char *text, ObjectType type) {
    Case c = {.name = name, .text = text, .object = {.type = type}};
    return c;
}

static void test_plane(void **state) {
    (void)state;
    Case c = make("plane", "plane { <0.3, 1, -0.4>, -0.7", OBJECT_PLANE);
    c.object.shape.plane =
        (PlaneShape){vec_normalize(vec3(0.3, 1, -0.4)), -0.7 / vec_length(vec3(0.3, 1, -0.4))};
    c.object.shape.plane.distance = -0.7;
    check(&c);
}

static void test_sphere(void **state) {
    (void)state;
    Case c = make("sphere", "sphere { <0.1, -0.1, 0.2>, 1.2", OBJECT_SPHERE);
    c.object.shape.sphere = (SphereShape){{0.1, -0.1, 0.2}, 1.2};
    check(&c);
}

static void test_box(void **state) {
    (void)state;
    Case c = make("box", "box { <-0.9, -0.6, -0.5>, <0.8, 0.75, 0.95>", OBJECT_BOX);
    c.object.shape.box = (BoxShape){{-0.9, -0.6, -0.5}, {0.8, 0.75, 0.95}};
    check(&c);
}

static void test_cylinder(void **state) {
    (void)state;
    Case c =
        make("cylinder", "cylinder { <0.2, -0.9, 0.1>, <-0.3, 0.8, -0.2>, 0.6", OBJECT_CYLINDER);
    c.object.shape.cone = (ConeShape){{0.2, -0.9, 0.1}, {-0.3, 0.8, -0.2}, 0.6, 0.6, false};
    check(&c);
    c.name = "open cylinder";
    c.text = "cylinder { <0.2, -0.9, 0.1>, <-0.3, 0.8, -0.2>, 0.6 open";
    c.object.shape.cone.open = true;
    check(&c);
}

static void test_cone(void **state) {
    (void)state;
    Case c = make("cone", "cone { <0.2, -0.9, 0.1>, 0.9, <-0.3, 0.8, -0.2>, 0.3", OBJECT_CONE);
    c.object.shape.cone = (ConeShape){{0.2, -0.9, 0.1}, {-0.3, 0.8, -0.2}, 0.9, 0.3, false};
    check(&c);
    c.name = "open pointed cone";
    c.text = "cone { <0.2, -0.9, 0.1>, 0, <-0.3, 0.8, -0.2>, 0.8 open";
    c.object.shape.cone = (ConeShape){{0.2, -0.9, 0.1}, {-0.3, 0.8, -0.2}, 0, 0.8, true};
    check(&c);
}

static void test_torus(void **state) {
    (void)state;
    Case c = make("torus", "torus { 0.9, 0.35", OBJECT_TORUS);
    c.object.shape.torus = (TorusShape){0.9, 0.35};
    check(&c);
    c = make("spindle torus", "torus { 0.4, 0.7", OBJECT_TORUS);
    c.object.shape.torus = (TorusShape){0.4, 0.7};
    check(&c);
}

static void test_disc(void **state) {
    (void)state;
    Case c = make("disc", "disc { <0.1, 0.05, 0.3>, <0.2, 0.5, -1>, 1.2, 0.4", OBJECT_DISC);
    c.object.shape.disc =
        (DiscShape){{0.1, 0.05, 0.3}, vec_normalize(vec3(0.2, 0.5, -1)), 1.2, 0.4};
    check(&c);
}

static void test_triangle(void **state) {
    (void)state;
    Case c = make("triangle", "triangle { <-1, -0.8, 0.3>, <1.1, -0.5, 0.9>, <0.2, 1, 0.6>",
                  OBJECT_TRIANGLE);
    c.object.shape.triangle = (TriangleShape){{{-1, -0.8, 0.3}, {1.1, -0.5, 0.9}, {0.2, 1, 0.6}}};
    check(&c);
}

static void test_grid_flat(void **state) {
    (void)state;
    Case cases[4];
    cases[0] = make("sphere", "sphere { 0, 1", OBJECT_SPHERE);
    cases[0].object.shape.sphere = (SphereShape){{0, 0, 0}, 1};
    cases[1] = make("box", "box { <-1, -0.75, -0.5>, <1, 0.5, 0.75>", OBJECT_BOX);
    cases[1].object.shape.box = (BoxShape){{-1, -0.75, -0.5}, {1, 0.5, 0.75}};
    cases[2] = make("disc", "disc { 0, z, 1, 0.5", OBJECT_DISC);
    cases[2].object.shape.disc = (DiscShape){{0, 0, 0}, {0, 0, 1}, 1, 0.5};
    cases[3] =
        make("triangle", "triangle { <-1, -1, 0>, <1, -1, 0.5>, <0, 1, 0.25>", OBJECT_TRIANGLE);
    cases[3].object.shape.triangle = (TriangleShape){{{-1, -1, 0}, {1, -1, 0.5}, {0, 1, 0.25}}};
    check_grid(cases, 4);
}

static void test_grid_round(void **state) {
    (void)state;
    Case cases[5];
    cases[0] = make("cylinder", "cylinder { -y, y, 0.75", OBJECT_CYLINDER);
    cases[0].object.shape.cone = (ConeShape){{0, -1, 0}, {0, 1, 0}, 0.75, 0.75, false};
    cases[1] = make("open cylinder", "cylinder { -y, y, 0.75 open", OBJECT_CYLINDER);
    cases[1].object.shape.cone = (ConeShape){{0, -1, 0}, {0, 1, 0}, 0.75, 0.75, true};
    cases[2] = make("cone", "cone { -y, 0.5, y, 1", OBJECT_CONE);
    cases[2].object.shape.cone = (ConeShape){{0, -1, 0}, {0, 1, 0}, 0.5, 1, false};
    cases[3] = make("pointed cone", "cone { -y, 1, y, 0", OBJECT_CONE);
    cases[3].object.shape.cone = (ConeShape){{0, -1, 0}, {0, 1, 0}, 1, 0, false};
    cases[4] = make("torus", "torus { 1, 0.5", OBJECT_TORUS);
    cases[4].object.shape.torus = (TorusShape){1, 0.5};
    check_grid(cases, 5);
}

static int create_pictures(void **state) {
    (void)state;
    pictures = povray_create(WIDTH, HEIGHT);
    return 0;
}

static int destroy_pictures(void **state) {
    (void)state;
    povray_destroy(pictures);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plane),     cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_box),       cmocka_unit_test(test_cylinder),
        cmocka_unit_test(test_cone),      cmocka_unit_test(test_torus),
        cmocka_unit_test(test_disc),      cmocka_unit_test(test_triangle),
        cmocka_unit_test(test_grid_flat), cmocka_unit_test(test_grid_round),
    };
    return cmocka_run_group_tests_name("shapes_povray", tests, create_pictures, destroy_pictures);
}
