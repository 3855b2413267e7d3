// SPDX-License-Identifier: MIT
// What the renderer relies on, checked once, so that nothing after it has an error path. Every
// refusal names the field. The order is the order of scene.h.
#include "model/scene.h"

#include "base/diag.h"
#include "model/check.h"
#include "model/scene_check.h"
#include "model/scene_format.h"
#include "patch/bezier.h"

#include <math.h>
#include <string.h>

enum { MAX_TRACE_LEVEL = 256 }; // POV-Ray's own limit

// ---- settings, camera, lights ---------------------------------------------------------------

static void check_settings(const Check *c) {
    const FieldPath path = path_field(NULL, "settings");
    const Settings *s = &c->scene->settings;
    check_range(c, &path, "version", s->version, 0, 999);
    check_range(c, &path, "gamma_mode", (int)s->gamma_mode, GAMMA_NONE, GAMMA_SRGB);
    check_float(c, &path, "assumed_gamma", s->assumed_gamma);
    if (s->gamma_mode == GAMMA_POWER && !(s->assumed_gamma > 0)) {
        const FieldPath gamma = path_field(&path, "assumed_gamma");
        refuse(c, &gamma, "%g is not positive", (double)s->assumed_gamma);
    }
    check_color(c, &path, "background", s->background);
    check_rgb(c, &path, "ambient_light", s->ambient_light);
    check_rgb(c, &path, "irid_wavelength", s->irid_wavelength);
    check_range(c, &path, "max_trace_level", s->max_trace_level, 0, MAX_TRACE_LEVEL);
    check_float(c, &path, "adc_bailout", s->adc_bailout);
    check_range(c, &path, "noise_generator", s->noise_generator, 1, 3);
}

static void check_focal_blur(const Check *c, const FieldPath *up, const FocalBlur *blur) {
    const FieldPath path = path_field(up, "focal_blur");
    const FieldPath confidence = path_field(&path, "confidence");
    check_numbers(c, &path, "aperture", &blur->aperture, 1);
    check_numbers(c, &path, "focal_distance", &blur->focal_distance, 1);
    check_range(c, &path, "samples", blur->samples, 1, CAMERA_MAX_BLUR_SAMPLES);
    check_numbers(c, &path, "variance", &blur->variance, 1);
    if (!(blur->confidence > 0 && blur->confidence < 1))
        refuse(c, &confidence, "it must lie between 0 and 1");
}

static void check_camera(const Check *c) {
    const FieldPath path = path_field(NULL, "camera");
    const Camera *camera = &c->scene->camera;
    check_range(c, &path, "type", (int)camera->type, CAMERA_PERSPECTIVE, CAMERA_SPHERICAL);
    check_vec3(c, &path, "location", camera->location);
    check_vec3(c, &path, "direction", camera->direction);
    check_vec3(c, &path, "up", camera->up);
    check_vec3(c, &path, "right", camera->right);
    check_numbers(c, &path, "angle", &camera->angle_deg, 1);
    check_numbers(c, &path, "spherical_angles", camera->spherical_deg, 2);
    if (camera->has_blur)
        check_focal_blur(c, &path, &camera->blur);
    if (camera->has_normal) {
        const FieldPath normal = path_field(&path, "normal");
        check_index(c, &normal, camera->normal, c->scene->normal_count, "normal");
    }
    if (!(vec_length(camera->direction) > 0)) {
        const FieldPath direction = path_field(&path, "direction");
        refuse(c, &direction, "it has no length");
    }
}

static void check_area_light(const Check *c, const FieldPath *path, const AreaLight *area) {
    check_vec3(c, path, "axis1", area->axis[0]);
    check_vec3(c, path, "axis2", area->axis[1]);
    check_range(c, path, "size1", area->size[0], 1, LIGHT_MAX_GRID);
    check_range(c, path, "size2", area->size[1], 1, LIGHT_MAX_GRID);
}

static void check_light(const Check *c, const FieldPath *path, const Light *light) {
    check_range(c, path, "type", (int)light->type, LIGHT_POINT, LIGHT_CYLINDER);
    check_vec3(c, path, "location", light->location);
    check_vec3(c, path, "point_at", light->point_at);
    check_rgb(c, path, "color", light->color);
    check_numbers(c, path, "fade_distance", &light->fade_distance, 1);
    check_numbers(c, path, "fade_power", &light->fade_power, 1);
    check_numbers(c, path, "radius", &light->radius, 1);
    check_numbers(c, path, "falloff", &light->falloff, 1);
    check_numbers(c, path, "tightness", &light->tightness, 1);
    if (light->has_projection) {
        const FieldPath projection = path_field(path, "projected_through");
        check_index(c, &projection, light->projection, c->scene->projection_count, "projection");
    }
    if (light->has_area) {
        const FieldPath area = path_field(path, "area");
        check_area_light(c, &area, &light->area);
    }
    if (light->type != LIGHT_POINT &&
        !(vec_length(vec_sub(light->point_at, light->location)) > 0)) {
        const FieldPath point_at = path_field(path, "point_at");
        refuse(c, &point_at, "it is the light's location");
    }
}

// ---- interiors, sky ------------------------------------------------------------------------

static void check_interior(const Check *c, const FieldPath *path, const Interior *interior) {
    check_not_zero(c, path, "ior", interior->ior);
    check_float(c, path, "caustics", interior->caustics);
    check_float(c, path, "fade_distance", interior->fade_distance);
    check_float(c, path, "fade_power", interior->fade_power);
    check_rgb(c, path, "fade_color", interior->fade_color);
    check_float(c, path, "refraction", interior->refraction);
    check_size(c, path, "dispersion", interior->dispersion);
    check_not_zero(c, path, "dispersion", interior->dispersion);
    check_range(c, path, "dispersion_samples", interior->dispersion_samples, 2,
                INTERIOR_MAX_DISPERSION);
}

static void check_sky_sphere(const Check *c) {
    const SkySphere *sky = &c->scene->sky_sphere;
    const FieldPath path = path_field(NULL, "sky_sphere");
    if (!c->scene->has_sky_sphere)
        return;
    if (sky->pigment_count == 0)
        refuse(c, &path, "it has no pigments");
    for (uint32_t i = 0; i < sky->pigment_count; i++) {
        const FieldPath item = path_item(&path, "pigments", i);
        check_index(c, &item, sky->pigments[i], c->scene->pigment_count, "pigment");
    }
    check_rgb(c, &path, "emission", sky->emission);
    check_transform(c, &path, "transform", &sky->transform);
}

static void check_fog(const Check *c, const FieldPath *path, const Fog *fog) {
    check_range(c, path, "type", (int)fog->type, FOG_CONSTANT, FOG_GROUND);
    check_numbers(c, path, "distance", &fog->distance, 1);
    if (fog->distance == 0) {
        const FieldPath distance = path_field(path, "distance");
        refuse(c, &distance, "it must not be 0");
    }
    check_numbers(c, path, "alt", &fog->alt, 1);
    check_numbers(c, path, "offset", &fog->offset, 1);
    check_vec3(c, path, "up", fog->up);
    check_color(c, path, "color", fog->color);
    check_float(c, path, "turb_depth", fog->turb_depth);
    if (fog->has_turbulence) {
        const FieldPath turbulence = path_field(path, "turbulence");
        check_turbulence(c, &turbulence, &fog->turbulence);
    }
}

static void check_rainbow(const Check *c, const FieldPath *path, const Rainbow *rainbow) {
    const FieldPath pigment = path_field(path, "pigment"), width = path_field(path, "width");
    check_index(c, &pigment, rainbow->pigment, c->scene->pigment_count, "pigment");
    check_vec3(c, path, "direction", rainbow->direction);
    check_vec3(c, path, "right", rainbow->right);
    check_vec3(c, path, "up", rainbow->up);
    check_numbers(c, path, "distance", &rainbow->distance, 1);
    check_numbers(c, path, "angle", &rainbow->angle_deg, 1);
    check_numbers(c, path, "width", &rainbow->width_deg, 1);
    if (rainbow->width_deg == 0)
        refuse(c, &width, "it must not be 0");
    check_numbers(c, path, "arc_angle", &rainbow->arc_deg, 1);
    check_numbers(c, path, "falloff_angle", &rainbow->falloff_deg, 1);
    check_numbers(c, path, "jitter", &rainbow->jitter, 1);
}

// ---- objects --------------------------------------------------------------------------------

static void check_weights(const Check *c, const FieldPath *path, const PatchShape *patch) {
    uint32_t columns = patch->degree_v + 1, count = (patch->degree_u + 1) * columns;
    double least = INFINITY, most = 0.0;
    for (uint32_t k = 0; k < count; k++) {
        const FieldPath row = path_item(path, "weights", k / columns);
        const FieldPath place = path_item(&row, NULL, k % columns);
        double w = patch->weights[k];
        if (!(isfinite(w) && w > 0.0))
            refuse(c, &place, "the weight %g is not above 0", w);
        least = fmin(least, w);
        most = fmax(most, w);
    }
    if (most / least > BEZIER_MAX_WEIGHTS)
        refuse(c, path, "the weights %g and %g differ by more than %g", least, most,
               BEZIER_MAX_WEIGHTS);
}

static void check_patch(const Check *c, const FieldPath *path, const PatchShape *patch) {
    if (patch->degree_u < 1 || patch->degree_u > SCENE_MAX_DEGREE || patch->degree_v < 1 ||
        patch->degree_v > SCENE_MAX_DEGREE)
        refuse(c, path, "the degrees %u and %u are not in the range 1 to %d", patch->degree_u,
               patch->degree_v, SCENE_MAX_DEGREE);
    check_range(c, path, "patch_type", patch->type, 0, 1);
    check_numbers(c, path, "flatness", &patch->flatness, 1);
    check_numbers(c, path, "uv", &patch->uv[0].u, 8);
    if (patch->weights)
        check_weights(c, path, patch);
    for (uint32_t i = 0; i <= patch->degree_u; i++) {
        for (uint32_t j = 0; j <= patch->degree_v; j++) {
            Vec3 p = patch->points[i * (patch->degree_v + 1) + j];
            const FieldPath row = path_item(path, "points", i);
            const FieldPath point = path_item(&row, NULL, j);
            // The path is made anyway, the check itself must be quick: there may be millions.
            if (!(fabs(p.x) <= MAX_COORDINATE && fabs(p.y) <= MAX_COORDINATE &&
                  fabs(p.z) <= MAX_COORDINATE))
                refuse(c, &point, "<%g, %g, %g> is out of range", p.x, p.y, p.z);
        }
    }
}

static void check_cone(const Check *c, const FieldPath *path, const ConeShape *cone) {
    check_vec3(c, path, "base", cone->base);
    check_vec3(c, path, "apex", cone->apex);
    check_size(c, path, "base_radius", cone->base_radius);
    check_size(c, path, "apex_radius", cone->apex_radius);
    if (!(vec_length(vec_sub(cone->apex, cone->base)) > 0))
        refuse(c, path, "base and apex are the same point");
}

static void check_box(const Check *c, const FieldPath *path, const BoxShape *box) {
    check_vec3(c, path, "low", box->low);
    check_vec3(c, path, "high", box->high);
    if (box->low.x > box->high.x || box->low.y > box->high.y || box->low.z > box->high.z)
        refuse(c, path, "'low' is above 'high'");
}

static void check_pairs(const Check *c, const FieldPath *path, const char *name,
                        const uint32_t *pairs, uint32_t count, uint32_t pool, const char *what) {
    for (uint32_t i = 0; i < count; i++) {
        const FieldPath place = path_item(path, name, i);
        const uint32_t *pair = &pairs[2 * (size_t)i];
        check_index(c, &place, pair[0], pool, what);
        check_index(c, &place, pair[1], pool, what);
        if (i > 0 && pair[0] <= pair[-2])
            refuse(c, &place, "%s %u is not above that of the pair before", what, pair[0]);
    }
}

static void check_instance(const Check *c, const FieldPath *path, const Object *object) {
    const InstanceShape *shape = &object->shape.instance;
    const FieldPath definition = path_field(path, "definition");
    check_index(c, &definition, shape->definition, c->scene->definition_count, "definition");
    check_pairs(c, path, "textures", shape->textures, shape->texture_count, c->scene->texture_count,
                "texture");
    check_pairs(c, path, "interiors", shape->interiors, shape->interior_count,
                c->scene->interior_count, "interior");
    if (object->interior_texture != NO_INDEX)
        refuse(c, path, "an instance has no 'interior_texture'");
    if (object->clips.count > 0 || object->bounds.count > 0)
        refuse(c, path, "an instance has no 'clipped_by' or 'bounded_by'");
}

static void check_shape(const Check *c, const FieldPath *path, const Object *object) {
    switch (object->type) {
    case OBJECT_UNION:
    case OBJECT_MERGE:
    case OBJECT_INTERSECTION:
        break; // check_list goes on
    case OBJECT_PATCH:
        check_patch(c, path, &object->shape.patch);
        break;
    case OBJECT_PLANE:
        check_unit(c, path, "normal", object->shape.plane.normal);
        check_numbers(c, path, "distance", &object->shape.plane.distance, 1);
        break;
    case OBJECT_SPHERE:
        check_vec3(c, path, "center", object->shape.sphere.center);
        check_size(c, path, "radius", object->shape.sphere.radius);
        break;
    case OBJECT_BOX:
        check_box(c, path, &object->shape.box);
        break;
    case OBJECT_CYLINDER:
    case OBJECT_CONE:
        check_cone(c, path, &object->shape.cone);
        break;
    case OBJECT_TORUS:
        check_size(c, path, "major", object->shape.torus.major);
        check_size(c, path, "minor", object->shape.torus.minor);
        break;
    case OBJECT_DISC:
        check_vec3(c, path, "center", object->shape.disc.center);
        check_unit(c, path, "normal", object->shape.disc.normal);
        check_size(c, path, "radius", object->shape.disc.radius);
        check_size(c, path, "hole", object->shape.disc.hole);
        break;
    case OBJECT_TRIANGLE:
        check_numbers(c, path, "points", &object->shape.triangle.p[0].x, 9);
        break;
    case OBJECT_INSTANCE:
        check_instance(c, path, object);
        break;
    default:
        check_solid(c, path, object);
    }
}

static void check_object(const Check *c, const FieldPath *path, const Object *object) {
    const FieldPath texture = path_field(path, "texture"), inside = path_field(path, "interior"),
                    inner = path_field(path, "interior_texture"),
                    transform = path_field(path, "transform");
    if ((int)object->type < OBJECT_UNION || object->type >= OBJECT_TYPE_COUNT)
        refuse(c, path, "unknown object type %d", (int)object->type);
    if (object->texture != NO_INDEX)
        check_index(c, &texture, object->texture, c->scene->texture_count, "texture");
    if (object->interior_texture != NO_INDEX)
        check_index(c, &inner, object->interior_texture, c->scene->texture_count, "texture");
    if (object->interior != NO_INDEX)
        check_index(c, &inside, object->interior, c->scene->interior_count, "interior");
    if (object->has_transform && !object_has_space(object->type))
        refuse(c, &transform, "this type has no local space");
    if (object->has_transform)
        check_transform(c, path, "transform", &object->transform);
    if (object->clips.count > 0 && object->type == OBJECT_PATCH)
        refuse(c, path, "a patch cannot have 'clipped_by': put it into a union that has");
    if (object->whole && (object->type != OBJECT_UNION || object->clips.count > 0))
        refuse(c, path, "'whole' is for unions without 'clipped_by'");
    if (object->difference && object->type != OBJECT_INTERSECTION && object->type != OBJECT_MERGE)
        refuse(c, path, "'difference' is for intersections and merges");
    if (object->cutaway && (object_is_tree(object) || object->texture != NO_INDEX))
        refuse(c, path, "'cutaway' is for primitives without a texture");
    check_shape(c, path, object);
}

// What is below it has been checked.
static void check_closed(const Check *c, const FieldPath *path, const Object *object) {
    bool good = !object->solid || object->type == OBJECT_UNION;
    for (uint32_t i = 0; good && object->solid && i < object->shape.children.count; i++) {
        const Object *child = &c->scene->objects[object->shape.children.items[i]];
        good = child->type == OBJECT_PATCH || child->type == OBJECT_UNION;
    }
    if (!good)
        refuse(c, path, "'solid' is for unions of patches");
}

// Instances stand in such objects.
static bool holds_instances(const Object *object) {
    return object->type == OBJECT_UNION && object->clips.count == 0 && object->bounds.count == 0 &&
           !object->whole && !object->solid;
}

// A list of objects and all that hangs below it. Each object may be met once, so the walk ends even
// if the lists lead back to themselves. open: instances may stand there.
static void check_list(Check *c, const FieldPath *up, const char *name, const uint32_t *items,
                       uint32_t count, int depth, bool open) {
    if (depth > SCENE_MAX_DEPTH)
        refuse(c, up, "more than %d unions inside one another", SCENE_MAX_DEPTH);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t index = items[i];
        const FieldPath place = path_item(up, name, i);
        check_index(c, &place, index, c->scene->object_count, "object");
        const FieldPath path = path_item(up, name, c->positions ? c->positions[index] : i);
        if (c->met[index])
            refuse(c, &place, "object %u is used twice", index);
        c->met[index] = true;
        const Object *object = &c->scene->objects[index];
        check_object(c, &path, object);
        if (object->type == OBJECT_INSTANCE && !open)
            refuse(c, &path,
                   "an instance stands only among objects, or in unions of them that "
                   "nothing cuts");
        if (object_is_tree(object))
            check_list(c, &path, "children", object->shape.children.items,
                       object->shape.children.count, depth + 1, open && holds_instances(object));
        check_closed(c, &path, object);
        if (object->clips.count > 0)
            check_list(c, &path, "clipped_by", object->clips.items, object->clips.count, depth + 1,
                       false);
        if (object->bounds.count > 0)
            check_list(c, &path, "bounded_by", object->bounds.items, object->bounds.count,
                       depth + 1, false);
    }
}

enum { MAX_SHOWN = 1 << 30 }; // leaves that instances show: each has a rank of its own

static uint32_t count_objects(const Scene *scene, uint32_t index) {
    const Object *object = &scene->objects[index];
    uint32_t count = 1;
    for (uint32_t i = 0; object_is_tree(object) && i < object->shape.children.count; i++)
        count += count_objects(scene, object->shape.children.items[i]);
    return count;
}

static void check_shown(Check *c) {
    const Scene *scene = c->scene;
    uint64_t shown = 0;
    uint32_t *sizes = ARENA_ARRAY(c->scratch, uint32_t, scene->definition_count);
    for (uint32_t i = 0; i < scene->definition_count; i++)
        sizes[i] = count_objects(scene, scene->definitions[i]);
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (scene->objects[i].type == OBJECT_INSTANCE)
            shown += sizes[scene->objects[i].shape.instance.definition];
    if (shown > MAX_SHOWN)
        refuse(c, NULL, "the instances show %llu objects, more than %d", (unsigned long long)shown,
               MAX_SHOWN);
}

static void check_objects(Check *c) {
    const Scene *scene = c->scene;
    check_list(c, NULL, "objects", scene->roots, scene->root_count, 0, true);
    check_list(c, NULL, "projections", scene->projections, scene->projection_count, 0, false);
    check_list(c, NULL, "definitions", scene->definitions, scene->definition_count, 0, false);
    for (uint32_t i = 0; i < scene->object_count; i++)
        if (!c->met[i])
            refuse(c, NULL, "object %u is part of no tree", i);
    check_shown(c);
}

// ---- the scene ------------------------------------------------------------------------------

static void check_scene(void *context) {
    Check *c = context;
    const Scene *scene = c->scene;
    check_settings(c);
    check_camera(c);
    check_sky_sphere(c);
    for (uint32_t i = 0; i < scene->fog_count; i++) {
        const FieldPath path = path_item(NULL, "fogs", i);
        check_fog(c, &path, &scene->fogs[i]);
    }
    for (uint32_t i = 0; i < scene->rainbow_count; i++) {
        const FieldPath path = path_item(NULL, "rainbows", i);
        check_rainbow(c, &path, &scene->rainbows[i]);
    }
    for (uint32_t i = 0; i < scene->light_count; i++) {
        const FieldPath path = path_item(NULL, "lights", i);
        check_light(c, &path, &scene->lights[i]);
    }
    check_functions(c);
    check_solid_pools(c);
    check_objects(c); // they are trees now: patterns look into them
    check_texture_pools(c);
    check_function_uses(c);
    for (uint32_t i = 0; i < scene->interior_count; i++) {
        const FieldPath path = path_item(NULL, "interiors", i);
        check_interior(c, &path, &scene->interiors[i]);
    }
}

static CheckPool make_pool(Arena *scratch, const char *name, uint32_t count) {
    return (CheckPool){name, count, ARENA_ARRAY(scratch, uint8_t, count),
                       ARENA_ARRAY(scratch, double, count), ARENA_ARRAY(scratch, uint8_t, count)};
}

void scene_validate_at(const Scene *scene, const char *file, const uint32_t *positions) {
    Arena *scratch = arena_create();
    Check c = {.scene = scene, .file = file, .positions = positions};
    c.met = ARENA_ARRAY(scratch, bool, scene->object_count);
    c.pigments = make_pool(scratch, "pigment", scene->pigment_count);
    c.normals = make_pool(scratch, "normal", scene->normal_count);
    c.textures = make_pool(scratch, "texture", scene->texture_count);
    c.functions = make_pool(scratch, "function", scene->function_count);
    c.projections = make_pool(scratch, "object", scene->projection_count);
    c.calls = ARENA_ARRAY(scratch, uint8_t, scene->function_count);
    c.scratch = scratch;
    char *message = NULL;
    bool good = diag_catch(check_scene, &c, &message);
    arena_destroy(scratch);
    if (!good)
        diag_rethrow(message);
}

void scene_validate(const Scene *scene, const char *file) { scene_validate_at(scene, file, NULL); }
