#include "passes/registry.hpp"

#include "passes/accumulate.hpp"
#include "passes/box_blur.hpp"
#include "passes/denoise_radial.hpp"
#include "passes/distance_transform.hpp"
#include "passes/emissive_faces.hpp"
#include "passes/empty_boxes.hpp"
#include "passes/filter_guide.hpp"
#include "passes/gather.hpp"
#include "passes/light_reservoirs.hpp"
#include "passes/modulate.hpp"
#include "passes/moved_voxels.hpp"
#include "passes/pack_surface.hpp"
#include "passes/radiance_cache.hpp"
#include "passes/ray_query_path_trace.hpp"
#include "passes/reference_path_trace.hpp"
#include "passes/resample_surface.hpp"
#include "passes/reuse_reservoirs.hpp"
#include "passes/temporal_accumulate.hpp"
#include "passes/tonemap.hpp"
#include "passes/upsample.hpp"
#include "passes/view_surface.hpp"
#include "passes/view_voxels.hpp"
#include "passes/voxel_merge.hpp"
#include "passes/voxel_path_trace.hpp"
#include "passes/voxelize.hpp"

namespace lightloom::passes {

void register_builtin_passes(PassRegistry& registry) {
  registry.add(make_voxelize());
  registry.add(make_voxel_merge());
  registry.add(make_distance_transform());
  registry.add(make_empty_boxes());
  registry.add(make_radiance_cache());
  registry.add(make_emissive_faces());
  registry.add(make_moved_voxels());
  registry.add(make_gather());
  registry.add(make_resample_surface());
  registry.add(make_light_reservoirs());
  registry.add(make_reuse_reservoirs());
  registry.add(make_voxel_path_trace());
  registry.add(make_reference_path_trace());
  registry.add(make_ray_query_path_trace());
  registry.add(make_pack_surface());
  registry.add(make_temporal_accumulate());
  registry.add(make_temporal_accumulate_packed());
  registry.add(make_accumulate());
  registry.add(make_filter_guide());
  registry.add(make_denoise_radial());
  registry.add(make_box_blur());
  registry.add(make_upsample());
  registry.add(make_modulate());
  registry.add(make_tonemap());
  registry.add(make_view_surface());
  registry.add(make_view_voxels());
}

}  // namespace lightloom::passes
