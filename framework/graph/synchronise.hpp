#pragma once

#include "framework/graph/plan.hpp"

namespace lightloom {

/// Fills every barrier of a plan whose clears, steps and observations are in place.
///
/// Model: frames follow one another on one queue, the same commands each. Every value has one write a frame, so its
/// life is a fixed round: write, reads of this frame's layer, reads of it as history in later frames, and,
/// `ring_layers` frames on, the next write to the same layer.
/// - read after write: once, before the first read that can meet the new layer, and at once for the accesses of all
///   readers, those of later frames included: whoever comes later finds it visible.
/// - write after read: before the write, from every reader's stages, in an earlier frame. It names the write's access,
///   so that the chain from the write before is a memory dependency, not of execution alone.
/// - write after write: only where nothing reads in between (scratch, an output nobody uses).
/// A persistent value has the same round: what its pass leaves from the frame before was made visible to all readers by
/// the barriers of that frame, and to the pass by those before its write.
/// What is written once has no next write: one barrier before the first reader, for the readers of all frames.
void synchronise(Plan& plan);

}  // namespace lightloom
