// What the scene has, as specialization constants that are filled by name. The defaults are the general case.
#ifndef LIGHTLOOM_LIB_FEATURES
#define LIGHTLOOM_LIB_FEATURES

layout(constant_id = 100) const bool has_dynamic = true;
layout(constant_id = 101) const bool has_emissive = true;
layout(constant_id = 102) const bool has_sun = true;
layout(constant_id = 103) const bool has_punctual = true;
layout(constant_id = 104) const bool has_environment = true;
layout(constant_id = 105) const bool has_environment_image = true;
layout(constant_id = 106) const bool has_textured = true;
layout(constant_id = 107) const bool has_alpha = true;
layout(constant_id = 108) const bool has_normal_mapped = true;
layout(constant_id = 109) const bool has_specular = true;
layout(constant_id = 110) const bool has_anisotropic = true;
layout(constant_id = 111) const bool has_metallic = true;

// The pages on which its materials have their textures of each kind, a bit for each (textures.glsl); 0: no material has
// one.
layout(constant_id = 120) const uint base_color_pages = 0xfffu;
layout(constant_id = 121) const uint metallic_roughness_pages = 0xfffu;
layout(constant_id = 122) const uint normal_pages = 0xfffu;
layout(constant_id = 123) const uint emissive_pages = 0xfffu;
layout(constant_id = 124) const uint anisotropy_pages = 0xfffu;
layout(constant_id = 125) const uint specular_pages = 0xfffu;
layout(constant_id = 126) const uint specular_color_pages = 0xfffu;

#endif
