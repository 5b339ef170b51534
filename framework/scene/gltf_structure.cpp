#include "framework/scene/gltf_structure.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>

#include "framework/base/limits.hpp"
#include "framework/scene/fail.hpp"

namespace lightloom::scene {
namespace {

using nlohmann::json;

constexpr uint64_t kElementArrayBuffer = 34963;

uint64_t integer_or(const json& object, const char* key, uint64_t fallback) {
  const auto found = object.find(key);
  return found == object.end() ? fallback : static_cast<uint64_t>(found->get<double>());
}

uint64_t component_size(uint64_t type) {
  return type <= 5121 ? 1 : type <= 5123 ? 2 : 4;
}

uint64_t component_count(std::string_view type) {
  if (type == "SCALAR") return 1;
  const auto digit = static_cast<uint64_t>(type.back() - '0');
  return type.starts_with("MAT") ? digit * digit : digit;
}

class StructureCheck {
 public:
  StructureCheck(const json& document, const std::string& file) : file_(file) {
    static const json none = json::array();
    const auto array = [&](const char* key) -> const json& { return document.contains(key) ? document[key] : none; };
    const json& accessors = array("accessors");
    buffers_ = &array("buffers");
    views_ = &array("bufferViews");
    for (size_t i = 0; i < views_->size(); ++i) check_view((*views_)[i], "bufferViews[" + std::to_string(i) + "]");
    for (size_t i = 0; i < accessors.size(); ++i) check_accessor(accessors[i], "accessors[" + std::to_string(i) + "]");
  }

 private:
  void check_view(const json& view, const std::string& name) const {
    const uint64_t offset = integer_or(view, "byteOffset", 0), length = integer_or(view, "byteLength", 0);
    const uint64_t whole = integer_or((*buffers_)[view["buffer"].get<size_t>()], "byteLength", 0);
    if (add_saturated(offset, length) > whole) {
      fail(file_, name,
           "(bytes " + std::to_string(offset) + " to " + std::to_string(add_saturated(offset, length)) +
               ") reaches past the end of its buffer of " + std::to_string(whole) + " bytes");
    }
    if (!view.contains("byteStride")) return;
    const uint64_t stride = integer_or(view, "byteStride", 0);
    if (stride % 4 != 0) refuse_stride(name, stride, "a multiple of 4");
    if (stride > length) refuse_stride(name, stride, "at most byteLength, which is " + std::to_string(length));
    if (integer_or(view, "target", 0) == kElementArrayBuffer)
      refuse_stride(name, stride, "none, as its target says that it holds indices");
  }

  void check_accessor(const json& accessor, const std::string& name) const {
    const uint64_t type = accessor["componentType"].get<uint64_t>();
    if (accessor.value("normalized", false) && type >= 5125)
      fail(file_, name + ".normalized",
           "is true for " + std::string(type == 5126 ? "floats" : "32-bit integers") +
               ", expected it for integers of 8 or 16 bits");
    const std::string& shape = accessor["type"].get_ref<const std::string&>();
    const uint64_t part = component_size(type), element = part * component_count(shape);
    const uint64_t count = accessor["count"].get<uint64_t>();
    if (accessor.contains("bufferView")) {
      check_alignment(accessor, shape, part, name);
      check_range(accessor, {.element = element, .count = count}, name);
    } else if (accessor.contains("byteOffset")) {
      fail(file_, name + ".byteOffset", "stands without bufferView, expected both or neither");
    }
    const auto sparse = accessor.find("sparse");
    if (sparse == accessor.end()) return;
    const uint64_t replaced = (*sparse)["count"].get<uint64_t>();
    if (replaced > count) {
      fail(file_, name + ".sparse.count",
           "replaces " + std::to_string(replaced) + " elements, expected at most the accessor's " +
               std::to_string(count));
    }
    const uint64_t index = component_size((*sparse)["indices"]["componentType"].get<uint64_t>());
    check_sparse((*sparse)["indices"], {.element = index, .count = replaced}, name + ".sparse.indices");
    check_sparse((*sparse)["values"], {.element = element, .count = replaced}, name + ".sparse.values");
  }

  struct Extent {
    uint64_t element = 0;  ///< [bytes]
    uint64_t count = 0;
  };

  [[nodiscard]] const json& view_of(const json& user) const { return (*views_)[user["bufferView"].get<size_t>()]; }

  void check_sparse(const json& user, const Extent& extent, const std::string& name) const {
    if (view_of(user).contains("byteStride"))
      fail(file_, name + ".bufferView",
           "is " + user["bufferView"].dump() + ", which has a byteStride, expected a view without");
    check_range(user, extent, name);
  }

  void check_alignment(const json& accessor, const std::string& shape, uint64_t part, const std::string& name) const {
    const uint64_t offset = integer_or(accessor, "byteOffset", 0);
    const uint64_t total = add_saturated(offset, integer_or(view_of(accessor), "byteOffset", 0));
    const uint64_t wanted = shape.starts_with("MAT") ? 4 : part;
    if (offset % wanted != 0 || total % wanted != 0) {
      fail(file_, name + ".byteOffset",
           "is " + std::to_string(offset) + ", at byte " + std::to_string(total) +
               " of its buffer, expected multiples of " + std::to_string(wanted));
    }
  }

  void check_range(const json& user, const Extent& extent, const std::string& name) const {
    const json& view = view_of(user);
    const std::string view_name = "bufferViews[" + user["bufferView"].dump() + "]";
    const uint64_t offset = integer_or(user, "byteOffset", 0), length = integer_or(view, "byteLength", 0);
    const uint64_t stride = integer_or(view, "byteStride", extent.element);
    if (stride < extent.element)
      refuse_stride(view_name, stride,
                    "at least the " + std::to_string(extent.element) + " bytes of an element of " + name);
    const uint64_t last = add_saturated(multiply_saturated(extent.count - 1, stride), extent.element);
    if (add_saturated(offset, last) > length) {
      fail(file_, name,
           "needs " + std::to_string(extent.count) + " elements of " + std::to_string(extent.element) +
               " bytes from byte " + std::to_string(offset) + ", which reach past the end of " + view_name + " of " +
               std::to_string(length) + " bytes");
    }
  }

  [[noreturn]] void refuse_stride(const std::string& view, uint64_t stride, const std::string& expected) const {
    fail(file_, view + ".byteStride", "is " + std::to_string(stride) + ", expected " + expected);
  }

  const std::string& file_;
  const json* buffers_ = nullptr;
  const json* views_ = nullptr;
};

}  // namespace

void check_gltf_structure(const json& document, const std::string& file) {
  StructureCheck(document, file);
}

}  // namespace lightloom::scene
