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

// Which textures its materials have, and on how many pages (textures.glsl).
layout(constant_id = 120) const bool uses_metallic_roughness_texture = true;
layout(constant_id = 121) const bool uses_emissive_texture = true;
layout(constant_id = 122) const bool uses_anisotropy_texture = true;
layout(constant_id = 123) const bool uses_specular_texture = true;
layout(constant_id = 124) const uint texture_page_count = 12u;

#endif
