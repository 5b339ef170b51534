#include "framework/gpu/image_use.hpp"

#include <spirv_cross/spirv.h>

#include <functional>
#include <set>
#include <vector>

namespace lightloom::gpu {
namespace {

constexpr size_t kHeaderWords = 5;

/// One instruction: its words without the first, which holds the length and the opcode.
struct Instruction {
  SpvOp code = SpvOpNop;
  std::span<const uint32_t> operands;
};

void for_each_instruction(std::span<const uint32_t> words, const std::function<void(const Instruction&)>& visit) {
  for (size_t i = kHeaderWords; i < words.size();) {
    const uint32_t length = words[i] >> SpvWordCountShift;
    if (length == 0 || i + length > words.size()) return;
    visit({static_cast<SpvOp>(words[i] & SpvOpCodeMask), words.subspan(i + 1, length - 1)});
    i += length;
  }
}

bool is_image_read(SpvOp code) {
  return (code >= SpvOpImageSampleImplicitLod && code <= SpvOpImageRead) ||
         (code >= SpvOpImageSparseSampleImplicitLod && code <= SpvOpImageSparseDrefGather) ||
         code == SpvOpImageSparseRead;
}

bool is_atomic(SpvOp code) {
  return code >= SpvOpAtomicLoad && code <= SpvOpAtomicXor;
}

/// Which ids stand for which others: a loaded image for its variable, a parameter for what it is called with.
class Origins {
 public:
  explicit Origins(std::span<const uint32_t> words) {
    for_each_instruction(words, [this](const Instruction& instruction) { collect(instruction); });
    for (const Call& call : calls_)
      for (size_t i = 0; i < call.arguments.size() && i < parameters_[call.function].size(); ++i)
        origins_[parameters_[call.function][i]].insert(call.arguments[i]);
  }

  /// The ids at the root of `id`.
  [[nodiscard]] std::set<uint32_t> roots(uint32_t id) const {
    std::set<uint32_t> seen;
    std::set<uint32_t> found;
    std::vector<uint32_t> open = {id};
    while (!open.empty()) {
      const uint32_t next = open.back();
      open.pop_back();
      if (!seen.insert(next).second) continue;
      const auto known = origins_.find(next);
      if (known == origins_.end()) {
        found.insert(next);
      } else {
        open.insert(open.end(), known->second.begin(), known->second.end());
      }
    }
    return found;
  }

 private:
  struct Call {
    uint32_t function = 0;
    std::span<const uint32_t> arguments;
  };

  void collect(const Instruction& instruction) {
    const std::span<const uint32_t> operands = instruction.operands;
    switch (instruction.code) {
      case SpvOpFunction:
        function_ = operands[1];
        break;
      case SpvOpFunctionParameter:
        parameters_[function_].push_back(operands[1]);
        break;
      case SpvOpFunctionCall:
        calls_.push_back({operands[2], operands.subspan(3)});
        break;
      case SpvOpLoad:
      case SpvOpAccessChain:
      case SpvOpInBoundsAccessChain:
      case SpvOpCopyObject:
      case SpvOpSampledImage:
      case SpvOpImage:
      case SpvOpImageTexelPointer:
        origins_[operands[1]].insert(operands[2]);
        break;
      default:
        break;
    }
  }

  std::map<uint32_t, std::set<uint32_t>> origins_;
  std::map<uint32_t, std::vector<uint32_t>> parameters_;
  std::vector<Call> calls_;
  uint32_t function_ = 0;
};

}  // namespace

std::map<uint32_t, ImageUse> image_uses(std::span<const uint32_t> words) {
  const Origins origins(words);
  std::map<uint32_t, ImageUse> uses;
  const auto note = [&](uint32_t image, ImageUse use) {
    for (const uint32_t root : origins.roots(image)) {
      uses[root].read = uses[root].read || use.read;
      uses[root].written = uses[root].written || use.written;
    }
  };
  for_each_instruction(words, [&](const Instruction& instruction) {
    const std::span<const uint32_t> operands = instruction.operands;
    if (instruction.code == SpvOpImageWrite || instruction.code == SpvOpAtomicStore) {
      note(operands[0], {false, true});
    } else if (is_image_read(instruction.code)) {
      note(operands[2], {true, false});
    } else if (is_atomic(instruction.code)) {
      note(operands[2], {true, instruction.code != SpvOpAtomicLoad});
    }
  });
  return uses;
}

}  // namespace lightloom::gpu
