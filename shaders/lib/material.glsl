// A glTF material at one point: textures, vertex colour, and the step from metallic-roughness to Ward lobes.
#ifndef LIGHTLOOM_LIB_MATERIAL
#define LIGHTLOOM_LIB_MATERIAL

#include "lib/color.glsl"
#include "lib/textures.glsl"

struct MaterialSample {
  vec3 base_color;    // linear
  float alpha;
  float metallic;
  vec2 ward_alpha;    // along the tangent and across it, kWardAlphaMin..1
  float f0;           // specular reflectance of the dielectric part at normal incidence …
  float f90;          // … and at grazing incidence
  vec3 emission;      // [W m^-2 sr^-1]
  bool unlit;         // base_color is what is seen; reflects nothing
  vec3 normal;        // unit, in the frame (tangent, bitangent, normal)
  vec2 direction;     // unit, of the lobe's long axis in the frame (tangent, bitangent)
};

// Below, the lobe's peak 1/(4 pi alpha^2) leaves half floats and the lobe is narrower than a normal is known.
const float kWardAlphaMin = 1e-3;

// Opacity alone: what an alpha test needs.
float material_alpha(uint id, TexturePoint point, vec4 vertex_color) {
  return materials[id].base_color.a * vertex_color.a *
         sample_texture(base_color_pages, materials[id].base_color_texture, point, vec4(1.0)).a;
}

bool alpha_masked(uint id) { return has_alpha && materials[id].flags.x == kAlphaMask; }

bool cut_out(uint id, float alpha) { return alpha_masked(id) && alpha < materials[id].shape.z; }

vec3 material_normal(uint id, TexturePoint point) {
  if (!has_normal_mapped || materials[id].normal_texture.page == kNoTexture) return vec3(0.0, 0.0, 1.0);
  const vec4 flat_normal = vec4(0.5, 0.5, 1.0, 1.0);
  vec3 n = sample_texture(normal_pages, materials[id].normal_texture, point, flat_normal).xyz * 2.0 - 1.0;
  n.xy *= materials[id].surface.w;
  float squared = dot(n, n);
  return squared > 1e-8 ? n * inversesqrt(squared) : vec3(0.0, 0.0, 1.0);
}

// KHR_materials_anisotropy: along the direction alpha grows to mix(alpha, 1, strength^2), across it stays.
void material_lobe(uint id, TexturePoint point, float roughness, out vec2 ward_alpha, out vec2 direction) {
  float alpha = roughness * roughness;
  ward_alpha = vec2(alpha);
  direction = vec2(1.0, 0.0);
  if (has_anisotropic && materials[id].specular.w > 0.0) {
    const vec4 along_tangent = vec4(1.0, 0.5, 1.0, 1.0);
    vec3 texel = sample_texture(anisotropy_pages, materials[id].anisotropy_texture, point, along_tangent).xyz;
    vec2 d = texel.xy * 2.0 - 1.0;
    vec2 turn = materials[id].shape.xy;
    d = vec2(turn.x * d.x - turn.y * d.y, turn.y * d.x + turn.x * d.y);
    float squared = dot(d, d);
    direction = squared > 1e-8 ? d * inversesqrt(squared) : turn;
    float strength = clamp(materials[id].specular.w * texel.z, 0.0, 1.0);
    ward_alpha.x = mix(alpha, 1.0, strength * strength);
  }
  ward_alpha = clamp(ward_alpha, kWardAlphaMin, 1.0);
}

// KHR_materials_specular and KHR_materials_ior; the colour factor counts by its luminance.
void material_specular(uint id, TexturePoint point, out float f0, out float f90) {
  f0 = 0.0;
  f90 = 0.0;
  if (!has_specular) return;
  f90 = materials[id].surface.z *
        sample_texture(specular_pages, materials[id].specular_texture, point, vec4(1.0)).a;
  vec3 color = materials[id].specular.rgb *
               sample_texture(specular_color_pages, materials[id].specular_color_texture, point, vec4(1.0)).rgb;
  f0 = min(materials[id].shape.w * luminance(color), 1.0) * f90;
}

vec3 material_emission(uint id, TexturePoint point) {
  if (!has_emissive) return vec3(0.0);
  vec3 factor = materials[id].emission.rgb;
  if (!any(greaterThan(factor, vec3(0.0)))) return vec3(0.0);
  return factor * sample_texture(emissive_pages, materials[id].emissive_texture, point, vec4(1.0)).rgb;
}

// Index into the emission table, by which the surface lights others. Dim texels are seen but light nothing: the host
// draws no light samples on them either.
uint emission_index(uint id, vec3 emission) {
  bool emits = any(greaterThan(emission, vec3(0.0))) && luminance(emission) >= materials[id].emission.w;
  return emits ? materials[id].flags.z : 0u;
}

MaterialSample sample_material(uint id, TexturePoint point, vec4 vertex_color) {
  MaterialSample s;
  vec4 base = materials[id].base_color * vertex_color *
              sample_texture(base_color_pages, materials[id].base_color_texture, point, vec4(1.0));
  s.base_color = base.rgb;
  s.alpha = base.a;
  vec4 texel = sample_texture(metallic_roughness_pages, materials[id].metallic_roughness_texture, point,
                              vec4(1.0));
  s.metallic = has_metallic ? clamp(materials[id].surface.x * texel.b, 0.0, 1.0) : 0.0;
  material_lobe(id, point, clamp(materials[id].surface.y * texel.g, 0.0, 1.0), s.ward_alpha, s.direction);
  material_specular(id, point, s.f0, s.f90);
  s.emission = material_emission(id, point);
  s.unlit = materials[id].flags.w != 0u;
  s.normal = material_normal(id, point);
  return s;
}

#endif
