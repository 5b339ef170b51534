#pragma once

#include "framework/graph/plan.hpp"

namespace lightloom {

/// Fills every barrier of a plan whose clears, steps and observations are in place, by SyncPolicy::conservative: one
/// full dependency before each of them on everything before. What `synchronise` finds must give the same bits.
void serialise(Plan& plan);

}  // namespace lightloom
