// Integer kernels for random graphs: every bit of the inputs reaches the output.
#extension GL_EXT_samplerless_texture_functions : require
uint mixed(uint hash, uint value) {
  hash ^= value + 0x9e3779b9u + (hash << 6) + (hash >> 2);
  hash *= 0x85ebca6bu;
  return hash ^ (hash >> 13);
}
