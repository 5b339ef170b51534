// Radiance from outside the scene, and the distribution of directions by which its light is sampled.
#ifndef LIGHTLOOM_LIB_ENVIRONMENT
#define LIGHTLOOM_LIB_ENVIRONMENT

#include "lib/features.glsl"
#include "lib/textures.glsl"

// Laid out by framework/scene/environment_sampler.hpp; read only where has_environment_image.
uniform sampler2D environment_table;

// Is there an image? Without one the environment is constant.
bool environment_is_image() { return has_environment_image && frame.environment.w > 0.5; }

// Equirectangular: row 0 is +y, column 0 is longitude -pi, longitude = atan(z, x). The polar angle is taken from atan
// as well: acos is off by up to a tenth of a row of the table on some devices.
vec2 environment_texcoord(vec3 direction) {
  const float pi = 3.14159265358979;
  float across = length(direction.xz);
  if (across == 0.0) return vec2(0.5, direction.y > 0.0 ? 0.0 : 1.0);
  return vec2(atan(direction.z, direction.x) / (2.0 * pi) + 0.5, atan(across, direction.y) / pi);
}

vec3 environment_radiance(vec3 direction) {
  if (!has_environment) return vec3(0.0);
  vec3 radiance = frame.environment.rgb;
  if (environment_is_image()) radiance *= textureLod(environment_map, environment_texcoord(direction), 0.0).rgb;
  return radiance;
}

const float kUniformSpherePdf = 0.0795774715459477;   // 1 / 4 pi [sr^-1]

// Cosine of the polar angle at which a row of the table ends.
float environment_row_end(ivec2 cells, int row) { return texelFetch(environment_table, ivec2(cells.x, row), 0).y; }

// Cell of the table that a direction lies in. The row is settled by the very cosines that directions are sampled
// between, so that both sides agree to the last bit.
ivec2 environment_cell(ivec2 cells, vec3 direction) {
  ivec2 cell = clamp(ivec2(environment_texcoord(direction) * vec2(cells)), ivec2(0), cells - 1);
  if (cell.y > 0 && direction.y > environment_row_end(cells, cell.y - 1)) return ivec2(cell.x, cell.y - 1);
  if (cell.y < cells.y - 1 && direction.y <= environment_row_end(cells, cell.y)) return ivec2(cell.x, cell.y + 1);
  return cell;
}

// Density with which sample_environment picks a unit direction [sr^-1].
float environment_pdf(vec3 direction) {
  if (!has_environment) return 0.0;
  if (!environment_is_image()) return kUniformSpherePdf;
  ivec2 cells = textureSize(environment_table, 0) - ivec2(1, 0);
  return texelFetch(environment_table, environment_cell(cells, direction), 0).y;
}

// First of `count` texels from `first` on, `stride` apart, whose cumulative probability is above u.
int environment_search(ivec2 first, ivec2 stride, int count, float u) {
  int low = 0;
  int high = count - 1;
  while (low < high) {
    int middle = (low + high) / 2;
    if (u < texelFetch(environment_table, first + stride * middle, 0).x) high = middle;
    else low = middle + 1;
  }
  return low;
}

// Picks a unit direction for four uniform numbers; false where all is black. `pdf` is environment_pdf(direction).
bool sample_environment(vec4 u, out vec3 direction, out float pdf) {
  const float pi = 3.14159265358979;
  ivec2 cells = ivec2(1);
  ivec2 cell = ivec2(0);
  vec2 ends = vec2(1.0, -1.0);
  direction = vec3(0.0, 1.0, 0.0);
  pdf = 0.0;
  if (!has_environment) return false;
  if (environment_is_image()) {
    cells = textureSize(environment_table, 0) - ivec2(1, 0);
    cell.y = environment_search(ivec2(cells.x, 0), ivec2(0, 1), cells.y, u.x);
    cell.x = environment_search(ivec2(0, cell.y), ivec2(1, 0), cells.x, u.y);
    ends.y = environment_row_end(cells, cell.y);
    if (cell.y > 0) ends.x = environment_row_end(cells, cell.y - 1);
  }
  float y = mix(ends.x, ends.y, u.z);
  float across = sqrt(max(0.0, (1.0 - y) * (1.0 + y)));
  float longitude = pi * (2.0 * (float(cell.x) + u.w) / float(cells.x) - 1.0);
  direction = vec3(across * cos(longitude), y, across * sin(longitude));
  // At the rim of a cell rounding may take the direction over to the next one: the density is that of where it is.
  pdf = environment_pdf(direction);
  return pdf > 0.0;
}

#endif
