// SPDX-License-Identifier: MIT
// Scene file -> Scene. jansson parses the text (and names line and column of a syntax error); the
// tables of scene_fields.h say what each object of the document may hold. Whatever is not there
// keeps its default, whatever is not known is refused by its path. Objects are numbered as a walk
// of the trees meets them: a parent, then its children.
#include "model/scene.h"

#include "base/diag.h"
#include "base/file.h"
#include "model/field_path.h"
#include "model/file_path.h"
#include "model/scene_check.h"
#include "model/scene_fields.h"
#include "model/scene_format.h"
#include "model/scene_read_json.h"
#include "model/scene_read_patch.h"
#include "model/scene_requires.h"

#include <string.h>

// ---- objects --------------------------------------------------------------------------------

static const char *const PATCH_KEYS[] = {"type",  "count",   "degree",  "points",     "weights",
                                         "basis", "knots_u", "knots_v", "bounded_by", NULL};
static const char *const TREE_KEYS[] = {"type", "children", "clipped_by", "bounded_by", NULL};
static const char *const OTHER_KEYS[] = {"type", "clipped_by", "bounded_by", NULL};

// The type of the object; *any_degree for "bezier_patch".
static ObjectType read_type(const Reader *r, const FieldPath *path, json_t *json,
                            bool *any_degree) {
    read_expect(r, path, json, JSON_OBJECT);
    const FieldPath type_path = path_field(path, "type");
    json_t *type = json_object_get(json, "type");
    if (!type)
        path_die(r->file, path, "'type' is missing");
    read_expect(r, &type_path, type, JSON_STRING);
    const char *name = json_string_value(type);
    *any_degree = strcmp(name, BEZIER_PATCH_NAME) == 0;
    if (*any_degree)
        return OBJECT_PATCH;
    for (int i = 0; OBJECT_TYPE_NAMES[i]; i++)
        if (strcmp(name, OBJECT_TYPE_NAMES[i]) == 0)
            return (ObjectType)i;
    path_die(r->file, &type_path, "unknown object type '%s'", name);
}

// How many objects one entry of a list makes without its children.
static uint32_t read_count(const Reader *r, const FieldPath *path, json_t *json) {
    json_t *count = json_object_get(json, "count");
    if (!count)
        return 1;
    const FieldPath count_path = path_field(path, "count");
    return (uint32_t)read_whole(r, &count_path, count, 1, NO_INDEX - 1);
}

// The same while counting: before memory is taken for a run, its points must be there. A patch has
// 4 points at least.
static uint32_t claim_count(Reader *r, const FieldPath *path, json_t *json) {
    json_t *count = json_object_get(json, "count");
    uint32_t patches = read_count(r, path, json);
    if (count && patches > r->patch_budget) {
        const FieldPath count_path = path_field(path, "count");
        path_die(r->file, &count_path, "%u patches are more than the buffers hold", patches);
    }
    r->patch_budget -= count ? patches : 0;
    return patches;
}

static uint64_t count_objects(Reader *r, const FieldPath *up, const char *name, json_t *list,
                              int depth) {
    const FieldPath list_path = path_field(up, name);
    read_expect(r, &list_path, list, JSON_ARRAY);
    if (depth > SCENE_MAX_DEPTH)
        path_die(r->file, &list_path, "more than %d unions inside one another", SCENE_MAX_DEPTH);
    uint64_t total = 0;
    size_t i;
    json_t *item;
    json_array_foreach(list, i, item) {
        const FieldPath path = path_item(up, name, (uint32_t)i);
        bool any_degree;
        ObjectType type = read_type(r, &path, item, &any_degree);
        json_t *children = json_object_get(item, "children");
        json_t *clips = json_object_get(item, "clipped_by");
        json_t *bounds = json_object_get(item, "bounded_by");
        if (type != OBJECT_PATCH && json_object_get(item, "count"))
            path_die(r->file, &path, "unknown field 'count'");
        total += claim_count(r, &path, item);
        if (children)
            total += count_objects(r, &path, "children", children, depth + 1);
        if (clips)
            total += count_objects(r, &path, "clipped_by", clips, depth + 1);
        if (bounds)
            total += count_objects(r, &path, "bounded_by", bounds, depth + 1);
    }
    return total;
}

// The bytes that a {"buffer", "byteOffset"} object points to: `size` of them, all inside.
static const unsigned char *read_reference(const Reader *r, const FieldPath *path, json_t *json,
                                           uint64_t size) {
    static const char *const KEYS[] = {"buffer", "byteOffset", NULL};
    read_expect(r, path, json, JSON_OBJECT);
    read_only_keys(r, path, json, NULL, KEYS);
    json_t *buffer = json_object_get(json, "buffer"), *offset = json_object_get(json, "byteOffset");
    if (!buffer || !offset)
        path_die(r->file, path, "'%s' is missing", buffer ? "byteOffset" : "buffer");
    const FieldPath buffer_path = path_field(path, "buffer");
    const FieldPath offset_path = path_field(path, "byteOffset");
    uint64_t number = read_whole(r, &buffer_path, buffer, 0, NO_INDEX);
    if (number >= r->buffer_count)
        path_die(r->file, &buffer_path, "%llu, but there %s %u buffer%s",
                 (unsigned long long)number, r->buffer_count == 1 ? "is" : "are", r->buffer_count,
                 r->buffer_count == 1 ? "" : "s");
    const Mapping *mapping = &r->buffers[number];
    uint64_t start = read_whole(r, &offset_path, offset, 0, INT64_MAX);
    if (start > mapping->size || size > mapping->size - start)
        path_die(r->file, &offset_path, "%llu bytes from %llu on, but the buffer ends at byte %zu",
                 (unsigned long long)size, (unsigned long long)start, mapping->size);
    return mapping->bytes + start;
}

// "points" as rows of the net; the degrees follow from their number.
static void read_net(const Reader *r, const FieldPath *path, json_t *json, PatchShape *patch) {
    size_t rows = json_array_size(json), columns = json_array_size(json_array_get(json, 0));
    if (rows < 2 || rows > SCENE_MAX_DEGREE + 1)
        path_die(r->file, path, "%zu rows of points, expected 2 to %d", rows, SCENE_MAX_DEGREE + 1);
    Vec3 *points = NULL;
    for (size_t i = 0; i < rows; i++) {
        const FieldPath row_path = path_item(path, NULL, (uint32_t)i);
        json_t *row = json_array_get(json, i);
        read_expect(r, &row_path, row, JSON_ARRAY);
        if (i == 0 && (columns < 2 || columns > SCENE_MAX_DEGREE + 1))
            path_die(r->file, &row_path, "%zu points, expected 2 to %d", columns,
                     SCENE_MAX_DEGREE + 1);
        if (json_array_size(row) != columns)
            path_die(r->file, &row_path, "%zu points, but the first row has %zu",
                     json_array_size(row), columns);
        if (!points)
            points = ARENA_ARRAY(r->arena, Vec3, rows * columns);
        for (size_t j = 0; j < columns; j++) {
            const FieldPath point_path = path_item(&row_path, NULL, (uint32_t)j);
            read_doubles(r, &point_path, json_array_get(row, j), &points[i * columns + j].x, 3);
        }
    }
    patch->points = points;
    patch->degree_u = (uint32_t)rows - 1;
    patch->degree_v = (uint32_t)columns - 1;
}

static void read_degree(const Reader *r, const FieldPath *up, json_t *json, PatchShape *patch) {
    const FieldPath path = path_field(up, "degree");
    double degree[2];
    read_doubles(r, &path, json, degree, 2);
    for (int i = 0; i < 2; i++)
        if (!(degree[i] >= 1 && degree[i] <= SCENE_MAX_DEGREE && degree[i] == (int)degree[i]))
            path_die(r->file, &path, "expected two whole numbers from 1 to %d", SCENE_MAX_DEGREE);
    patch->degree_u = (uint32_t)degree[0];
    patch->degree_v = (uint32_t)degree[1];
}

// The points, and perhaps the texture coordinates, of `count` patches from a buffer. objects[0] is
// complete otherwise; it becomes all of them.
static void read_run(const Reader *r, const FieldPath *path, json_t *json, Object *objects,
                     uint32_t count) {
    const FieldPath points_path = path_field(path, "points"), uv_path = path_field(path, "uv");
    PatchShape *first = &objects->shape.patch;
    size_t points = (size_t)(first->degree_u + 1) * (first->degree_v + 1);
    const unsigned char *bytes = read_reference(r, &points_path, json_object_get(json, "points"),
                                                (uint64_t)count * points * sizeof(Vec3));
    Vec3 *net = ARENA_ARRAY(r->arena, Vec3, count * points);
    binary_read(&net->x, bytes, (size_t)count * points * 3);
    for (uint32_t i = 0; i < count; i++) {
        objects[i] = objects[0];
        objects[i].shape.patch.points = net + i * points;
    }
    json_t *uv = json_object_get(json, "uv");
    if (!json_is_object(uv))
        return;
    bytes = read_reference(r, &uv_path, uv, (uint64_t)count * sizeof first->uv);
    for (uint32_t i = 0; i < count; i++)
        binary_read(&objects[i].shape.patch.uv[0].u, bytes + i * sizeof first->uv, 8);
}

static void read_patch(const Reader *r, const FieldPath *path, json_t *json, Object *objects,
                       uint32_t count, bool any_degree) {
    const FieldPath points_path = path_field(path, "points");
    json_t *points = json_object_get(json, "points"), *degree = json_object_get(json, "degree");
    PatchShape *patch = &objects->shape.patch;
    if (!points)
        path_die(r->file, path, "'points' is missing");
    if (json_is_array(points)) {
        if (degree || json_object_get(json, "count"))
            path_die(r->file, path, "'%s' goes only with points in a buffer",
                     degree ? "degree" : "count");
        read_net(r, &points_path, points, patch);
    } else if (degree) {
        read_degree(r, path, degree, patch);
    }
    if (!any_degree && (patch->degree_u != 3 || patch->degree_v != 3))
        path_die(r->file, &points_path,
                 "a bicubic_patch has 4 rows of 4 points (use bezier_patch)");
    static const char *const WITH_ROWS[] = {"weights", "basis", "knots_u", "knots_v"};
    for (int i = 0; i < 4; i++)
        if ((!any_degree || !json_is_array(points)) && json_object_get(json, WITH_ROWS[i]))
            path_die(r->file, path, "'%s' goes only with the points of a bezier_patch",
                     WITH_ROWS[i]);
    if (!json_is_array(points))
        read_run(r, path, json, objects, count);
    else if (any_degree)
        read_patch_basis(r, path, json, patch);
}

static uint32_t *read_objects(Reader *r, const FieldPath *up, const char *name, json_t *list,
                              uint32_t *count);

// One entry of a list; writes the indices of what it makes to *items and returns their number.
static uint32_t read_object(Reader *r, const FieldPath *path, json_t *json, uint32_t position,
                            uint32_t *items) {
    bool any_degree;
    ObjectType type = read_type(r, path, json, &any_degree);
    uint32_t count = type == OBJECT_PATCH ? read_count(r, path, json) : 1;
    Object *objects = &r->scene->objects[r->object_count];
    for (uint32_t i = 0; i < count; i++) {
        items[i] = r->object_count + i;
        r->positions[r->object_count + i] = position;
    }
    r->object_count += count;

    *objects = object_default(type);
    bool tree = object_is_tree(objects);
    read_record(r, path, json, object_record(type), objects,
                type == OBJECT_PATCH ? PATCH_KEYS
                : tree               ? TREE_KEYS
                                     : OTHER_KEYS);
    if (type == OBJECT_PATCH)
        read_patch(r, path, json, objects, count, any_degree);
    if (tree) {
        json_t *children = json_object_get(json, "children");
        if (!children)
            path_die(r->file, path, "'children' is missing");
        objects->shape.children.items =
            read_objects(r, path, "children", children, &objects->shape.children.count);
    }
    json_t *clips = json_object_get(json, "clipped_by");
    if (clips)
        objects->clips.items = read_objects(r, path, "clipped_by", clips, &objects->clips.count);
    json_t *bounds = json_object_get(json, "bounded_by");
    if (bounds && count > 1)
        path_die(r->file, path, "'bounded_by' of more than one patch: give each its own");
    if (bounds)
        objects->bounds.items = read_objects(r, path, "bounded_by", bounds, &objects->bounds.count);
    return count;
}

static uint32_t *read_objects(Reader *r, const FieldPath *up, const char *name, json_t *list,
                              uint32_t *count) {
    size_t total = 0, i;
    json_t *item;
    json_array_foreach(list, i, item) {
        const FieldPath path = path_item(up, name, (uint32_t)i);
        total += read_count(r, &path, item);
    }
    uint32_t *items = ARENA_ARRAY(r->arena, uint32_t, total);
    *count = 0;
    json_array_foreach(list, i, item) {
        const FieldPath path = path_item(up, name, (uint32_t)i);
        *count += read_object(r, &path, item, (uint32_t)i, items + *count);
    }
    return items;
}

// ---- buffers --------------------------------------------------------------------------------

// A side file stands in the scene file's folder or below it, never elsewhere.
static bool leaves_folder(const char *uri) {
    if (uri[0] == '/' || uri[0] == '\0')
        return true;
    for (const char *part = uri; part; part = strchr(part, '/')) {
        part += *part == '/';
        if (strncmp(part, "..", 2) == 0 && (part[2] == '/' || part[2] == '\0'))
            return true;
    }
    return false;
}

static void read_buffer(Reader *r, const FieldPath *path, json_t *json, Mapping *mapping) {
    static const char *const KEYS[] = {"uri", "byteLength", NULL};
    const FieldPath uri_path = path_field(path, "uri");
    const FieldPath length_path = path_field(path, "byteLength");
    read_expect(r, path, json, JSON_OBJECT);
    read_only_keys(r, path, json, NULL, KEYS);
    json_t *uri = json_object_get(json, "uri"), *length = json_object_get(json, "byteLength");
    if (!uri || !length)
        path_die(r->file, path, "'%s' is missing", uri ? "byteLength" : "uri");
    read_expect(r, &uri_path, uri, JSON_STRING);
    const char *name = json_string_value(uri), *why;
    if (leaves_folder(name))
        path_die(r->file, &uri_path, "'%s' is not in the folder of the scene file", name);
    uint64_t size = read_whole(r, &length_path, length, 0, INT64_MAX);
    char *file = path_beside_file(r->arena, name, r->file);
    if (!binary_map(file, mapping, &why))
        path_die(r->file, &uri_path, "cannot read '%s': %s", file, why);
    if (mapping->size != size)
        path_die(r->file, &length_path, "%llu, but '%s' has %zu bytes", (unsigned long long)size,
                 file, mapping->size);
}

static void read_buffers(Reader *r) {
    json_t *list = json_object_get(r->root, "buffers");
    if (!list)
        return;
    const FieldPath list_path = path_field(NULL, "buffers");
    read_expect(r, &list_path, list, JSON_ARRAY);
    r->buffers = ARENA_ARRAY(r->scratch, Mapping, json_array_size(list));
    // Counted one by one: scene_read unmaps what was mapped before one was refused.
    for (size_t i = 0; i < json_array_size(list); i++) {
        const FieldPath path = path_item(NULL, "buffers", (uint32_t)i);
        read_buffer(r, &path, json_array_get(list, i), &r->buffers[i]);
        r->buffer_count++;
        r->patch_budget += r->buffers[i].size / (4 * sizeof(Vec3));
    }
}

// ---- the document ---------------------------------------------------------------------------

static json_t *parse(const char *file, Arena *scratch) {
    size_t size;
    const char *why;
    char *text = file_read(scratch, file, &size, &why);
    if (!text)
        die("cannot read '%s': %s", file, why);
    json_error_t error;
    json_t *root = json_loadb(text, size, JSON_REJECT_DUPLICATES, &error);
    if (!root) {
        // With a NUL in the text the caret line would come from the wrong place.
        Loc loc = {.file = file, .line = error.line, .column = error.column};
        loc.text = strlen(text) == size ? text : NULL;
        die_at(&loc, "%s", error.text);
    }
    return root;
}

// Format and version first: nothing else can be judged before.
static void read_header(const Reader *r) {
    const FieldPath format_path = path_field(NULL, "format");
    const FieldPath version_path = path_field(NULL, "version");
    read_expect(r, NULL, r->root, JSON_OBJECT);
    json_t *format = json_object_get(r->root, "format");
    if (!json_is_string(format) || strcmp(json_string_value(format), SCENE_FORMAT) != 0)
        path_die(r->file, &format_path, "this is no scene file: expected \"%s\"", SCENE_FORMAT);
    json_t *version = json_object_get(r->root, "version");
    if (!version)
        path_die(r->file, NULL, "'version' is missing");
    read_expect(r, &version_path, version, JSON_INTEGER);
    if (json_integer_value(version) != SCENE_VERSION)
        path_die(r->file, &version_path, "%lld, but this program reads only version %d",
                 (long long)json_integer_value(version), SCENE_VERSION);
    json_t *requires = json_object_get(r->root, "requires"), *word;
    if (!requires)
        return;
    const FieldPath list_path = path_field(NULL, "requires");
    read_expect(r, &list_path, requires, JSON_ARRAY);
    size_t i;
    json_array_foreach(requires, i, word) {
        const FieldPath path = path_item(NULL, "requires", (uint32_t)i);
        read_expect(r, &path, word, JSON_STRING);
        if (!scene_requires_known(json_string_value(word)))
            path_die(r->file, &path, "the scene needs '%s', which this program does not have",
                     json_string_value(word));
    }
}

static void read_document(void *context) {
    static const char *const KEYS[] = {"format",  "version",     "requires",    "buffers",
                                       "objects", "projections", "definitions", NULL};
    Reader *r = context;
    Scene *scene = r->scene;
    r->root = parse(r->file, r->scratch);
    read_header(r);
    SCENE_RECORD.set_default(scene);
    read_record(r, NULL, r->root, &SCENE_RECORD, scene, KEYS);
    read_buffers(r);
    json_t *objects = json_object_get(r->root, "objects");
    json_t *projections = json_object_get(r->root, "projections");
    json_t *definitions = json_object_get(r->root, "definitions");
    uint64_t total = 0;
    if (objects)
        total += count_objects(r, NULL, "objects", objects, 0);
    if (projections)
        total += count_objects(r, NULL, "projections", projections, 0);
    if (definitions)
        total += count_objects(r, NULL, "definitions", definitions, 0);
    if (total >= NO_INDEX)
        path_die(r->file, NULL, "more objects than can be numbered");
    scene->object_count = (uint32_t)total;
    scene->objects = ARENA_ARRAY(r->arena, Object, scene->object_count);
    r->positions = ARENA_ARRAY(r->scratch, uint32_t, scene->object_count);
    if (objects)
        scene->roots = read_objects(r, NULL, "objects", objects, &scene->root_count);
    if (projections)
        scene->projections =
            read_objects(r, NULL, "projections", projections, &scene->projection_count);
    if (definitions)
        scene->definitions =
            read_objects(r, NULL, "definitions", definitions, &scene->definition_count);
    // Scripts add and remove objects; what is needed is read off the scene itself.
    scene_collect_requires(scene, r->arena);
    scene_validate_at(scene, r->file, r->positions);
}

Scene *scene_read(const char *path, Arena *arena) {
    Reader r = {.file = path, .arena = arena, .scratch = arena_create()};
    r.scene = ARENA_NEW(arena, Scene);
    char *message = NULL;
    bool good = diag_catch(read_document, &r, &message);
    for (uint32_t i = 0; i < r.buffer_count; i++)
        binary_unmap(&r.buffers[i]);
    json_decref(r.root);
    arena_destroy(r.scratch);
    if (!good)
        diag_rethrow(message);
    return r.scene;
}
