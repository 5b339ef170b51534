// Material textures: pages are array images of one size and colour space each, sampled with trilinear filtering and
// repeat. Wrap modes and nearest filtering are done here, because one page serves textures with different samplers.
// Pages are selected by constant indices: dynamic indexing of sampled images is not available on every device.
#ifndef LIGHTLOOM_LIB_TEXTURES
#define LIGHTLOOM_LIB_TEXTURES

#include "lib/scene.glsl"

uniform sampler2DArray texture_pages[kTexturePageCount];
uniform sampler2D environment_map;   // equirectangular, linear radiance; sampled only where has_environment_image

#endif
