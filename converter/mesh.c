// SPDX-License-Identifier: MIT
// mesh and mesh2 (facts: sdl 4.2). Normals, and the points of mesh2, are kept in single precision,
// as POV-Ray keeps them; of a mesh it takes the planes of the triangles before it rounds the
// points, so those stay as they were written. Textures stay with the object, since its transforms
// move them.
#include "converter/nodes.h"

#include <math.h>

typedef ARRAY(double) Doubles;

typedef struct {
    Doubles points, normals, uv;
    ARRAY(MeshFace) faces;
    ARRAY(const TextureNode *) textures;
    Vec3 inside;
    bool visible; // is a triangle there whose points do not lie on a line?
} MeshReader;

// POV-Ray's limit of what counts as no direction.
static const double NO_LENGTH = 1e-10;

static uint32_t put_vec3(Doubles *list, Vec3 v) {
    array_push(list, v.x);
    array_push(list, v.y);
    array_push(list, v.z);
    return (uint32_t)(list->count / 3 - 1);
}

static uint32_t put_single(Doubles *list, Vec3 v) {
    return put_vec3(list, vec3((float)v.x, (float)v.y, (float)v.z));
}

static uint32_t put_normal(Converter *cv, MeshReader *r, Vec3 n, const Token *token) {
    if (fabs(n.x) < NO_LENGTH && fabs(n.y) < NO_LENGTH && fabs(n.z) < NO_LENGTH) {
        Loc loc = token_loc(cv, token);
        warn_at(&loc, "a normal of the mesh has no length: <1, 0, 0> takes its place");
        n = vec3(1, 0, 0);
    }
    return put_single(&r->normals, vec_normalize(n));
}

static uint32_t put_uv(MeshReader *r, Vec2 uv) {
    array_push(&r->uv, uv.u);
    array_push(&r->uv, uv.v);
    return (uint32_t)(r->uv.count / 2 - 1);
}

static uint32_t put_texture(MeshReader *r, const TextureNode *texture) {
    // Triangles in a row mostly share theirs.
    for (size_t i = r->textures.count; i > 0 && i + 16 > r->textures.count; i--)
        if (r->textures.items[i - 1] == texture)
            return (uint32_t)(i - 1);
    array_push(&r->textures, texture);
    return (uint32_t)(r->textures.count - 1);
}

static MeshFace empty_face(void) {
    MeshFace face;
    for (int i = 0; i < 3; i++)
        face.p[i] = face.n[i] = face.uv[i] = face.texture[i] = NO_INDEX;
    return face;
}

static bool has_direction(Vec3 v) {
    return fabs(v.x) >= NO_LENGTH || fabs(v.y) >= NO_LENGTH || fabs(v.z) >= NO_LENGTH;
}

// Hands over what was read.
static void keep_mesh(Converter *cv, MeshReader *r, ObjectNode *object) {
    Mesh *mesh = ARENA_NEW(cv->arena, Mesh);
#define KEEP(list) arena_copy(cv->arena, r->list.items, r->list.count * sizeof *r->list.items)
    *mesh = (Mesh){.points = KEEP(points),
                   .point_count = (uint32_t)(r->points.count / 3),
                   .normals = KEEP(normals),
                   .normal_count = (uint32_t)(r->normals.count / 3),
                   .uv = KEEP(uv),
                   .uv_count = (uint32_t)(r->uv.count / 2),
                   .faces = KEEP(faces),
                   .face_count = (uint32_t)r->faces.count,
                   .texture_slots = (int)r->textures.count,
                   .has_inside = has_direction(r->inside),
                   .inside_vector = r->inside};
    object->textures = KEEP(textures);
#undef KEEP
    object->texture_count = (uint32_t)r->textures.count;
    object->has_textures = r->textures.count > 0;
    object->textured = true;
    for (uint32_t i = 0; i < mesh->face_count; i++)
        object->textured = object->textured && mesh->faces[i].texture[0] != NO_INDEX;
    object->mesh = mesh;
    object->surface = !mesh->has_inside;
    extent_begin(object);
    array_free(&r->points);
    array_free(&r->normals);
    array_free(&r->uv);
    array_free(&r->faces);
    array_free(&r->textures);
}

// ---- mesh -----------------------------------------------------------------------------------

static const TextureNode *accept_texture(Converter *cv) {
    const Value *value = accept_value(cv, VALUE_TEXTURE);
    if (value)
        return value->node;
    return accept(cv, KW_texture) ? parse_texture_block(cv) : NULL;
}

// texture { ID } | texture_list { ID ID ID }
static void parse_face_textures(Converter *cv, MeshReader *r, MeshFace *face) {
    if (accept(cv, KW_texture)) {
        expect(cv, '{', "texture");
        const Value *value = accept_value(cv, VALUE_TEXTURE);
        if (!value)
            die_expected(cv, "'texture identifier' (a triangle's texture is a declared one)");
        face->texture[0] = put_texture(r, value->node);
        expect(cv, '}', "texture");
        return;
    }
    if (!accept(cv, KW_texture_list))
        return;
    expect(cv, '{', "texture_list");
    for (int i = 0; i < 3; i++) {
        const TextureNode *texture = accept_texture(cv);
        if (!texture)
            die_expected(cv, "three textures in 'texture_list'");
        face->texture[i] = put_texture(r, texture);
        optional_comma(cv);
    }
    expect(cv, '}', "texture_list");
}

// triangle { V V V ... } | smooth_triangle { V V V V V V ... }
static void parse_face(Converter *cv, MeshReader *r, bool smooth) {
    MeshFace face = empty_face();
    Vec3 p[3];
    expect(cv, '{', "triangle");
    for (int i = 0; i < 3; i++) {
        if (i > 0)
            optional_comma(cv);
        p[i] = parse_vector(cv);
        face.p[i] = put_vec3(&r->points, p[i]);
        if (!smooth)
            continue;
        optional_comma(cv);
        const Token *token = peek_token(cv);
        face.n[i] = put_normal(cv, r, parse_vector(cv), token);
    }
    optional_comma(cv);
    if (accept(cv, KW_uv_vectors))
        for (int i = 0; i < 3; i++) {
            face.uv[i] = put_uv(r, parse_uv(cv));
            optional_comma(cv);
        }
    parse_face_textures(cv, r, &face);
    expect(cv, '}', "triangle");
    array_push(&r->faces, face);
    if (vec_length(vec_cross(vec_sub(p[1], p[0]), vec_sub(p[2], p[0]))) != 0.0)
        r->visible = true;
}

void parse_mesh(Converter *cv, ObjectNode *object) {
    MeshReader r = {0};
    for (;;) {
        if (accept(cv, KW_triangle))
            parse_face(cv, &r, false);
        else if (accept(cv, KW_smooth_triangle))
            parse_face(cv, &r, true);
        else if (accept(cv, KW_inside_vector))
            r.inside = parse_vector(cv);
        else
            break;
    }
    if (!r.visible)
        die_expected(cv, "'triangle' (No triangles in triangle mesh)");
    keep_mesh(cv, &r, object);
}

// ---- mesh2 ----------------------------------------------------------------------------------

// { n, items }: how many.
static uint32_t begin_list(Converter *cv, const char *where) {
    expect(cv, '{', where);
    return read_count(cv, where, 0);
}

static void parse_vectors(Converter *cv, MeshReader *r, const Token *list) {
    uint32_t count = begin_list(cv, list->text);
    for (uint32_t i = 0; i < count; i++) {
        const Token *token = peek_token(cv);
        if (list->code == KW_vertex_vectors)
            put_single(&r->points, parse_vector(cv));
        else if (list->code == KW_normal_vectors)
            put_normal(cv, r, parse_vector(cv), token);
        else
            put_uv(r, parse_uv(cv));
        optional_comma(cv);
    }
    expect(cv, '}', list->text);
}

static void parse_textures(Converter *cv, MeshReader *r) {
    uint32_t count = begin_list(cv, "texture_list");
    for (uint32_t i = 0; i < count; i++) {
        const TextureNode *texture = accept_texture(cv);
        if (!texture)
            die_expected(cv, "a texture");
        array_push(&r->textures, texture);
        optional_comma(cv);
    }
    expect(cv, '}', "texture_list");
}

static uint32_t check_index(Converter *cv, const Token *token, double value, size_t count,
                            const char *what) {
    if (value > -1 && value < (double)count)
        return (uint32_t)(int)value;
    Loc loc = token_loc(cv, token);
    die_at(&loc, "%s %g, but there are %zu", what, value, count);
}

static void read_indices(Converter *cv, uint32_t out[3], size_t count, const char *what) {
    const Token *token = peek_token(cv);
    Vec3 v = parse_vector(cv);
    for (int i = 0; i < 3; i++)
        out[i] = check_index(cv, token, vec_get(v, i), count, what);
    optional_comma(cv);
}

// { n, { V [F [F F]] }* }. Without a texture_list a number that begins is the next vector's.
static void parse_faces(Converter *cv, MeshReader *r) {
    uint32_t count = begin_list(cv, "face_indices");
    for (uint32_t i = 0; i < count; i++) {
        MeshFace face = empty_face();
        read_indices(cv, face.p, r->points.count / 3, "point");
        for (int k = 0; k < 3 && r->textures.count && !next_is(cv, '<') && starts_expression(cv);
             k++) {
            const Token *token = peek_token(cv);
            face.texture[k] = check_index(cv, token, parse_float(cv), r->textures.count, "texture");
            optional_comma(cv);
        }
        array_push(&r->faces, face);
    }
    expect(cv, '}', "face_indices");
}

static void parse_uv_indices(Converter *cv, MeshReader *r, const Token *list) {
    uint32_t count = begin_list(cv, list->text);
    if (count != r->faces.count) {
        Loc loc = token_loc(cv, list);
        die_at(&loc, "%u uv_indices for %zu faces", count, r->faces.count);
    }
    for (uint32_t i = 0; i < count; i++)
        read_indices(cv, r->faces.items[i].uv, r->uv.count / 2, "uv vector");
    expect(cv, '}', list->text);
}

static void parse_normal_indices(Converter *cv, MeshReader *r, const Token *list) {
    uint32_t count = begin_list(cv, list->text);
    if (count > r->faces.count) {
        Loc loc = token_loc(cv, list);
        die_at(&loc, "%u normal_indices for %zu faces", count, r->faces.count);
    }
    for (uint32_t i = 0; i < count; i++)
        read_indices(cv, r->faces.items[i].n, r->normals.count / 3, "normal");
    expect(cv, '}', list->text);
}

// Without indices of their own normals and uv vectors go by those of the points.
static void fill_indices(Converter *cv, MeshReader *r, bool uv, bool normals, const Token *token) {
    size_t points = r->points.count / 3, uv_count = r->uv.count / 2;
    size_t normal_count = r->normals.count / 3;
    bool all_uv = !uv && uv_count == points, all_normals = !normals && normal_count == points;
    if ((!uv && !all_uv && uv_count > 1) || (!normals && !all_normals && normal_count > 0)) {
        Loc loc = token_loc(cv, token);
        die_at(&loc, "%s are missing in the mesh2",
               !normals && !all_normals && normal_count > 0 ? "normal_indices" : "uv_indices");
    }
    for (size_t i = 0; i < r->faces.count; i++)
        for (int k = 0; k < 3; k++) {
            MeshFace *face = &r->faces.items[i];
            if (all_uv)
                face->uv[k] = face->p[k];
            else if (!uv && uv_count == 1)
                face->uv[k] = 0;
            if (all_normals)
                face->n[k] = face->p[k];
        }
}

// uv_indices { n V* } and normal_indices { n V* }, each once, and what is missing of them.
static void parse_indices(Converter *cv, MeshReader *r, const Token *start) {
    bool uv = false, normals = false;
    for (;;) {
        const Token *token = peek_token(cv);
        bool again = token->code == KW_uv_indices ? uv : normals;
        if (!accept(cv, KW_uv_indices) && !accept(cv, KW_normal_indices))
            break;
        if (again) {
            Loc loc = token_loc(cv, token);
            die_at(&loc, "Only one %s section is allowed in mesh2", token->text);
        }
        if (token->code == KW_uv_indices)
            parse_uv_indices(cv, r, token);
        else
            parse_normal_indices(cv, r, token);
        *(token->code == KW_uv_indices ? &uv : &normals) = true;
    }
    fill_indices(cv, r, uv, normals, start);
}

void parse_mesh2(Converter *cv, ObjectNode *object) {
    MeshReader r = {0};
    const Token *start = peek_token(cv), *token = start;
    while (accept(cv, KW_vertex_vectors) || accept(cv, KW_normal_vectors) ||
           accept(cv, KW_uv_vectors)) {
        parse_vectors(cv, &r, token);
        token = peek_token(cv);
    }
    if (accept(cv, KW_texture_list))
        parse_textures(cv, &r);
    if (r.points.count == 0) {
        Loc loc = token_loc(cv, start);
        die_at(&loc, "a mesh2 needs vertex_vectors and face_indices");
    }
    expect(cv, KW_face_indices, "mesh2");
    parse_faces(cv, &r);
    if (r.faces.count == 0) {
        Loc loc = token_loc(cv, start);
        die_at(&loc, "No triangles in triangle mesh");
    }
    parse_indices(cv, &r, start);
    while (accept(cv, KW_inside_vector))
        r.inside = parse_vector(cv);
    keep_mesh(cv, &r, object);
}
