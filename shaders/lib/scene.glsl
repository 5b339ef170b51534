// What every shader may read of the scene and the frame, bound by name. Mirrored by framework/run/scene_layout.hpp; a
// test compares the two by reflection. World space: metres, right-handed, y up as in glTF.
#ifndef LIGHTLOOM_LIB_SCENE
#define LIGHTLOOM_LIB_SCENE

const uint kHistoryLimit = 16u;      // ages 0..15 of the camera are kept
const uint kEmissionLimit = 256u;    // emission table; entry 0 is "no emission"
const uint kHintLimit = 1024u;       // light sample points drawn on the host each frame
const uint kPunctualLimit = 64u;
const uint kTexturePageCount = 12u;
const uint kGeometryPieces = 4u;

// Frame state. `eye.w` is 1 for a perspective camera (xyz: position [m]) and 0 for an orthographic one (xyz: unit
// direction towards the viewer), so the direction to the viewer is normalize(eye.xyz - position * eye.w).
layout(std140) uniform FrameBlock {
  mat4 view_projection[kHistoryLimit];  // [age] world to Vulkan clip space (y down, depth 0..1)
  vec4 eye[kHistoryLimit];              // [age]
  mat4 inverse_view_projection;         // age 0
  uvec4 ids;               // x: frame index, y: seed, z: number of earlier frames that histories hold, w: unused
  vec4 scene_min;          // bounds over all frames [m]; w: unused
  vec4 scene_max;
  vec4 sun_direction;      // xyz: unit direction the light travels in; w: unused
  vec4 sun_irradiance;     // rgb on a surface that faces the sun [W m^-2]; w: 1 - cosine of the angular radius
  vec4 environment;        // rgb: radiance, or the scale of environment_map [W m^-2 sr^-1]
  uvec4 counts;            // x: static triangles, y: dynamic triangles, z: hints, w: punctual lights
  uvec4 motion;            // first dynamic vertex, dynamic vertices; of past_positions: newest slot, slots filled
} frame;

// Packed as floats so that std430 has no padding. color: RGBA8 unorm in linear space, as uint bits.
struct StoredVertex {
  float px, py, pz, u0;
  float nx, ny, nz, v0;
  float tx, ty, tz, tw;    // w: sign of the bitangent = cross(normal, tangent) * w
  float u1, v1;
  uint color;
  uint reserved;
};
struct StoredTriangle { uint a, b, c, material, object; };

// Static ones first, then dynamic. A device may bind less of a buffer at once than a scene has, so that both lie in pieces
// of 2^bits elements; vertex_at and triangle_at find them.
layout(std430) readonly buffer VertexBlock { StoredVertex vertices[]; } vertex_pieces[kGeometryPieces];
layout(std430) readonly buffer TriangleBlock { StoredTriangle triangles[]; } triangle_pieces[kGeometryPieces];
layout(constant_id = 130) const uint vertex_piece_bits = 31u;
layout(constant_id = 131) const uint vertex_piece_count = 1u;
layout(constant_id = 132) const uint triangle_piece_bits = 31u;
layout(constant_id = 133) const uint triangle_piece_count = 1u;

struct Vertex {
  vec3 position;   // [m]
  vec3 normal;
  vec4 tangent;
  vec4 texcoords;  // set 0 in xy, 1 in zw
  vec4 color;
};
struct Triangle { uint a, b, c, material, object; };

// What of it is not used is not read.
Vertex vertex_at(uint index) {
  uint piece = index >> vertex_piece_bits;
  uint at = index & ((1u << vertex_piece_bits) - 1u);
  StoredVertex v = vertex_pieces[0].vertices[at];
  if (vertex_piece_count > 1u && piece == 1u) v = vertex_pieces[1].vertices[at];
  if (vertex_piece_count > 2u && piece == 2u) v = vertex_pieces[2].vertices[at];
  if (vertex_piece_count > 3u && piece == 3u) v = vertex_pieces[3].vertices[at];
  return Vertex(vec3(v.px, v.py, v.pz), vec3(v.nx, v.ny, v.nz), vec4(v.tx, v.ty, v.tz, v.tw),
                vec4(v.u0, v.v0, v.u1, v.v1), unpackUnorm4x8(v.color));
}

Triangle triangle_at(uint index) {
  uint piece = index >> triangle_piece_bits;
  uint at = index & ((1u << triangle_piece_bits) - 1u);
  StoredTriangle t = triangle_pieces[0].triangles[at];
  if (triangle_piece_count > 1u && piece == 1u) t = triangle_pieces[1].triangles[at];
  if (triangle_piece_count > 2u && piece == 2u) t = triangle_pieces[2].triangles[at];
  if (triangle_piece_count > 3u && piece == 3u) t = triangle_pieces[3].triangles[at];
  return Triangle(t.a, t.b, t.c, t.material, t.object);
}

// Where the dynamic vertices were: kHistoryLimit slots, used in turn, of frame.motion.y positions [m]; see motion.glsl.
layout(std430) readonly buffer PastPositionBlock { vec4 past_positions[]; };

struct TextureSlot {
  uint page;               // 0xFFFFFFFF: no texture
  uint layer;
  uint texcoord;           // 0 or 1
  uint sampling;           // bits 0-1 wrap u, 2-3 wrap v (0 repeat, 1 clamp, 2 mirror); bit 4: nearest
  vec4 linear_transform;   // column-major 2x2: uv' = (x*u + z*v, y*u + w*v) + offset
  vec2 offset;
  vec2 reserved;
};

const uint kAlphaOpaque = 0u;
const uint kAlphaMask = 1u;      // BLEND is treated as MASK with cutoff 0.5
struct Material {
  vec4 base_color;         // linear
  vec4 emission;           // rgb: factor * strength [W m^-2 sr^-1]; w: luminance below which a texel does not emit
  vec4 surface;            // metallic, perceptual roughness, specular factor, normal scale
  vec4 specular;           // rgb: specular colour factor; w: anisotropy strength
  vec4 shape;              // cos, sin of the anisotropy rotation; alpha cutoff; dielectric F0 (0.04 at an index of 1.5)
  uvec4 flags;             // x: alpha mode, y: double sided, z: index into the emission table, w: unlit
  TextureSlot base_color_texture;          // sRGB page
  TextureSlot metallic_roughness_texture;  // g: roughness, b: metallic
  TextureSlot normal_texture;
  TextureSlot emissive_texture;            // sRGB page
  TextureSlot anisotropy_texture;          // rg: direction, b: strength
  TextureSlot specular_texture;            // a: factor
  TextureSlot specular_color_texture;      // sRGB page
};
layout(std430) readonly buffer MaterialBlock { Material materials[]; };

struct Emission {          // the same in every frame
  vec4 radiance;           // rgb [W m^-2 sr^-1]; w: luminance over that of the brightest entry
  vec4 sides;              // x: 1 if both sides emit, else 0
};
struct Emitter {           // the triangles of an entry of the emission table
  vec4 surface;            // x: density of the hints drawn on it [m^-2]; y: area that emits, one side of it [m^2]
};
struct Hint {
  vec4 position;           // xyz [m]; w: index into the emission table
  vec4 normal;             // xyz: unit geometric normal of the emitter; w: its triangle (exact below 2^24)
};
const uint kPunctualPoint = 0u;
const uint kPunctualSpot = 1u;
const uint kPunctualDirectional = 2u;
struct PunctualLight {
  vec4 position;           // xyz [m]; w: range [m], 0 = unlimited
  vec4 direction;          // xyz: unit direction the light travels in; w: type
  vec4 intensity;          // rgb: [W sr^-1], directional: irradiance [W m^-2]
  vec4 cone;               // x: scale, y: offset of the spot's angular attenuation (KHR_lights_punctual)
};
layout(std140) uniform LightBlock {
  Emission emissions[kEmissionLimit];
  Emitter emitters[kEmissionLimit];
  Hint hints[kHintLimit];
  PunctualLight punctual[kPunctualLimit];
} lights;

#endif
