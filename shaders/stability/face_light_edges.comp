// Light of a lamp's faces at a point in the open, drawn at the ends of the random numbers: all combinations of five words.
#version 460
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_GOOGLE_include_directive : require

#include "lib/emitters.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

uniform texture3D distance_field;
uniform texture3D voxels_albedo;
uniform texture3D voxels_normal;
uniform texture3D voxels_material;
uniform writeonly image2D out_light;   // rgb: light; a: 1

layout(push_constant) uniform Params {
  float x;   // [m]
  float y;
  float z;
};

const uint words[5] = uint[5](0u, 1u, 0x80000000u, 0xFFFFFF00u, 0xFFFFFFFFu);

void main() {
  ivec2 place = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(place, imageSize(out_light)))) return;
  uvec4 bits = uvec4(words[place.x % 5], words[place.x / 5], words[place.y % 5], words[place.y / 5]);
  Grid grid = scene_grid(textureSize(distance_field, 0));
  PathVertex vertex;
  vertex.position = vec3(x, y, z);
  vertex.origin = world_to_grid(grid, vertex.position);
  vertex.geometric_normal = vec3(0.0, 1.0, 0.0);
  vertex.basis = make_frame(vertex.geometric_normal, vec3(1.0, 0.0, 0.0));
  vertex.incoming = vec3(0.0, 0.0, 1.0);
  vertex.bsdf = Bsdf(vec3(1.0), 0.0, 0.0, 0.0, vec2(1.0));
  PerLobe light = face_light(grid, distance_field, voxels_normal, voxels_material, vertex, bits);
  imageStore(out_light, place, vec4(light.diffuse + light.specular, 1.0));
}
