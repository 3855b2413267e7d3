// SPDX-License-Identifier: MIT
// Lights that have a size (facts: rendering 5): a grid of points about the light's location. A
// recursion over rectangles of the grid asks for the shadow at their corners and divides those that
// are not even; a rectangle counts as the mean of its parts, so the points do not all weigh the
// same.
#include "render/shading.h"

#include <math.h>

// Corners that differ by more lie in different light.
static const double UNEVEN = 0.1;

typedef struct {
    Tracer *tracer;
    const Surface *surface;
    const AreaLight *area;
    uint32_t index;
    Vec3 axis[2]; // turned to the surface when the light is oriented
    Rgb color;    // before shadows
    bool foggy;   // the light is dimmed by fog
    Vec3 fog_dir; // of the way that fog dims, and how long it is
    double fog_distance;
} Grid;

static double jitter_next(Tracer *tracer) { return tracer_random(&tracer->area_jitter) - 0.5; }

static void turn_axes(const AreaLight *area, Vec3 towards, Vec3 axis[2]) {
    axis[0] = area->axis[0];
    axis[1] = area->axis[1];
    if (!area->orient)
        return;
    // Any vector that is not along the light will do; which one decides on where the points lie.
    Vec3 other = fabs(fabs(towards.z) - 1.0) < 0.01 ? vec3(0, 1, 0) : vec3(0, 0, 1);
    Vec3 across = vec_normalize(vec_cross(towards, other));
    double length = vec_length(area->axis[0]); // POV-Ray makes it square
    axis[0] = vec_scale(across, length);
    axis[1] = vec_scale(vec_normalize(vec_cross(towards, across)), length);
}

// tracer: NULL where nothing jitters.
static Vec2 place_of(const AreaLight *area, Tracer *tracer, int i, int j) {
    double at[2] = {i, j};
    for (int k = 0; k < 2; k++) {
        if (area->jitter)
            at[k] += jitter_next(tracer);
        at[k] = area->size[k] > 1 ? at[k] / (area->size[k] - 1) - 0.5 : 0.0;
    }
    if (area->circular && area->size[0] > 1 && area->size[1] > 1) {
        // The square is drawn in to a disc; POV-Ray shifts the points off its middle.
        at[0] += 0.001;
        at[1] += 0.001;
        double far = hypot(at[0], at[1]);
        double scale = far > 0.0 ? fmax(fabs(at[0]), fabs(at[1])) / far : 1.0;
        at[0] *= scale;
        at[1] *= scale;
    }
    return (Vec2){at[0], at[1]};
}

Vec2 *area_places(const AreaLight *area, Arena *arena) {
    if (area->jitter)
        return NULL;
    size_t points = (size_t)area->size[0] * (size_t)area->size[1];
    Vec2 *places = ARENA_ARRAY(arena, Vec2, points);
    for (int i = 0; i < area->size[0]; i++)
        for (int j = 0; j < area->size[1]; j++)
            places[(size_t)i * (size_t)area->size[1] + (size_t)j] = place_of(area, NULL, i, j);
    return places;
}

static Vec3 grid_offset(const Grid *grid, int i, int j) {
    const AreaLight *area = grid->area;
    const Vec2 *places = grid->tracer->shading->places[grid->index];
    Vec2 at = places ? places[(size_t)i * (size_t)area->size[1] + (size_t)j]
                     : place_of(area, grid->tracer, i, j);
    return vec_add(vec_scale(grid->axis[0], at.u), vec_scale(grid->axis[1], at.v));
}

// Not yet asked for: no colour of light is so dark.
static const float UNKNOWN = -1e30f;

static const Rgb *grid_color(Grid *grid, int i, int j) {
    Tracer *tracer = grid->tracer;
    Rgb *color = &tracer->grid[(size_t)i * (size_t)grid->area->size[1] + (size_t)j];
    if (color->r != UNKNOWN)
        return color;
    const WorldHit *hit = grid->surface->hit;
    LightSample s;
    *color = grid->color;
    if (!light_aim(tracer->shading, grid->index, hit->p, grid_offset(grid, i, j), &s))
        return color; // nothing can be between
    grid->fog_distance = shadow_filter_point(tracer, grid->index, hit, s.dir, s.distance,
                                             grid->surface->path->inside, color);
    return color;
}

static bool uneven(const Rgb *a, const Rgb *b) {
    return fabs(a->r - b->r) + fabs(a->g - b->g) + fabs(a->b - b->b) > UNEVEN;
}

// POV-Ray looks at the light's middle anew before it goes into a part, but adds the middle to
// itself by mistake. Only fog notices: it lies along the way that was looked at last.
static void look_twice_as_far(Grid *grid) {
    const Shading *shading = grid->tracer->shading;
    LightSample s;
    if (!light_aim(shading, grid->index, grid->surface->hit->p,
                   shading->scene->lights[grid->index].location, &s))
        return;
    grid->fog_dir = s.dir;
    grid->fog_distance = s.distance;
}

static void rectangle_color(Grid *grid, int left, int low, int right, int high, int level,
                            Rgb *color) {
    const int corner[4][2] = {{left, low}, {right, low}, {left, high}, {right, high}};
    const Rgb *c[4];
    Rgb parts[4];
    for (int k = 0; k < 4; k++)
        c[k] = grid_color(grid, corner[k][0], corner[k][1]);
    bool divide = level < grid->area->adaptive || uneven(c[0], c[1]) || uneven(c[1], c[3]) ||
                  uneven(c[3], c[2]) || uneven(c[2], c[0]);
    if (divide && (right - left > 1 || high - low > 1)) {
        int x0 = (left + right) / 2, x1 = (left + right + 1) / 2;
        int y0 = (low + high) / 2, y1 = (low + high + 1) / 2;
        const int part[4][4] = {
            {left, low, x0, y0}, {x1, low, right, y0}, {left, y1, x0, high}, {x1, y1, right, high}};
        for (int k = 0; k < 4; k++) {
            if (grid->foggy)
                look_twice_as_far(grid);
            rectangle_color(grid, part[k][0], part[k][1], part[k][2], part[k][3], level + 1,
                            &parts[k]);
            c[k] = &parts[k];
        }
    }
    *color = rgb_scale(rgb_add(rgb_add(rgb_add(*c[0], *c[1]), *c[2]), *c[3]), 0.25);
}

void area_shadow(Tracer *tracer, const Surface *surface, uint32_t index, LightSample *sample) {
    const Shading *shading = tracer->shading;
    const Light *light = &shading->scene->lights[index];
    const AreaLight *area = &light->area;
    Grid grid = {.tracer = tracer,
                 .surface = surface,
                 .area = area,
                 .index = index,
                 .color = sample->color,
                 .foggy = light->media_attenuation,
                 .fog_dir = sample->dir};
    turn_axes(area, sample->dir, grid.axis);
    size_t points = (size_t)area->size[0] * (size_t)area->size[1];
    for (size_t i = 0; i < points; i++)
        tracer->grid[i].r = UNKNOWN;
    rectangle_color(&grid, 0, 0, area->size[0] - 1, area->size[1] - 1, 0, &sample->color);
    if (grid.foggy)
        shadow_fog(shading, index, (Ray){surface->hit->p, grid.fog_dir}, grid.fog_distance,
                   surface->path->inside, &sample->color);
}

void area_shine(Tracer *tracer, const LitLayer *layer, uint32_t index, const LightSample *sample,
                Rgb *color) {
    const Light *light = &tracer->shading->scene->lights[index];
    const AreaLight *area = &light->area;
    Grid grid = {.tracer = tracer,
                 .surface = layer->surface,
                 .area = area,
                 .index = index,
                 .color = sample->color};
    turn_axes(area, sample->dir, grid.axis);
    double points = area->size[0] * area->size[1];
    Rgb part = rgb((float)(sample->color.r / points), (float)(sample->color.g / points),
                   (float)(sample->color.b / points));
    for (int j = 0; j < area->size[1]; j++)
        for (int i = 0; i < area->size[0]; i++) {
            LightSample s;
            light_sample(tracer->shading, index, layer->surface->hit->p, grid_offset(&grid, i, j),
                         &s);
            s.color = rgb_scale(part, s.attenuation);
            bool dark, behind = light_behind(layer, s.dir, &dark);
            if (!dark)
                light_shine(tracer, layer, light->shadowless, &s, behind, color);
        }
}
