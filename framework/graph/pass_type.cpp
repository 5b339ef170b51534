#include "framework/graph/pass_type.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "framework/base/error.hpp"

namespace lightloom {
namespace {

/// Checks the table of one pass type against the rules of port.hpp and param.hpp.
class TableCheck {
 public:
  explicit TableCheck(const PassType& type) : type_(type) {}

  void run() const {
    require(!type_.name.empty(), "has no name");
    require(static_cast<bool>(type_.record) != static_cast<bool>(type_.host),
            "needs either a record or a host function");
    std::set<std::pair<std::string, bool>> ports;
    for (const Port& port : type_.ports) {
      // An input and an output may share a name, scratch and outputs may not: both are "pass.port" to a dump.
      require(ports.insert({port.name, port.direction == Direction::in}).second,
              "declares port '" + port.name + "' twice");
      check_port(port);
    }
    std::set<std::string> params;
    for (const Param& param : type_.params) {
      require(params.insert(param.name).second, "declares param '" + param.name + "' twice");
      check_param(param);
    }
    if (type_.reads_with) check_reads();
  }

 private:
  void require(bool condition, const std::string& problem) const {
    if (!condition) throw Error(ExitCode::run_failed, "pass type '" + type_.name + "' " + problem);
  }

  void check_port(const Port& port) const {
    const std::string which = "port '" + port.name + "' ";
    require(!port.name.empty() && !port.parts.empty(), which + "needs a name and at least one part");
    check_parts(port, which);
    check_extent(port, which);
    require(!port.needed_with || port.optional, which + "depends on params and must be optional");
    if (type_.host) check_host_port(port, which);
    const AccessInfo& access = access_info(port.access);
    if (port.direction == Direction::in) {
      require(access.reads && !access.writes, which + "is an input, its access must read and not write");
      require(!port.bypass, which + "is an input and cannot have a bypass");
      require(!port.persistent, which + "is an input and cannot be persistent");
      require(!port.array || port.dimension == Dimension::d2, which + "cannot be an array of 3D images");
      return;
    }
    require(access.writes, which + "is written, but its access does not write");
    require(!port.optional && !port.array, which + "is no input and cannot be optional or an array");
    require(!port.persistent || port.access != Access::depth_attachment_write,
            which + "is a depth attachment, which each draw clears, and cannot be persistent");
    require(port.direction == Direction::out || !port.bypass, which + "is scratch and cannot have a bypass");
    if (port.bypass && !port.bypass->input.empty()) check_bypass(port, which);
  }

  void check_host_port(const Port& port, const std::string& which) const {
    require(port.direction != Direction::scratch && !port.array && !port.persistent,
            which + "of a host pass cannot be scratch, an array or persistent");
    require(port.access == (port.direction == Direction::in ? Access::transfer_read : Access::transfer_write),
            which + "of a host pass must have access transfer_read (inputs) or transfer_write (outputs)");
  }

  void check_parts(const Port& port, const std::string& which) const {
    std::set<std::string> names;
    for (const PortPart& part : port.parts)
      require(names.insert(part.name).second, which + "declares part '" + part.name + "' twice");
    const bool single = port.parts.size() == 1 && port.parts.front().name.empty();
    require(single == port.bundle.empty(), which + "must either be a bundle of named parts or one part without a name");
    require(single || !names.contains(""), which + "has a part without a name");
  }

  void check_extent(const Port& port, const std::string& which) const {
    const Param* resolution = type_.find_param("resolution");
    require(port.extent != ExtentRule::grid || (resolution != nullptr && resolution->type == ParamType::integer &&
                                                resolution->minimum && *resolution->minimum >= 1),
            which + "lies on the grid, which needs an integer param 'resolution' with a minimum of at least 1");
    require(port.extent != ExtentRule::any || port.direction == Direction::in, which + "needs a rule for its extent");
    require((port.extent == ExtentRule::like) != port.like.empty(),
            which + "must name a port exactly if it is `like` it");
    require(port.extent == ExtentRule::like || port.times == Extent3{},
            which + "is so many times as large as nothing: only what is `like` a port can be");
    require(port.times.width >= 1 && port.times.height >= 1 && port.times.depth >= 1, which + "has no size");
    if (port.extent != ExtentRule::like) return;
    const Port* model = type_.find_port(port.like, Direction::in);
    require(model != nullptr && model != &port, which + "is like '" + port.like + "', which is no other input");
    require(!model->optional || port.direction != Direction::in,
            which + "is an input like '" + port.like + "', which may be unconnected");
  }

  void check_bypass(const Port& port, const std::string& which) const {
    const Port* source = type_.find_port(port.bypass->input, Direction::in);
    require(source != nullptr, which + "is bypassed by '" + port.bypass->input + "', which is no input");
    require(source->bundle == port.bundle && source->dimension == port.dimension && !source->array,
            which + "and its bypass '" + source->name + "' are of different kinds");
    for (const PortPart& part : port.parts) {
      const auto same = std::find_if(source->parts.begin(), source->parts.end(),
                                     [&](const PortPart& other) { return other.name == part.name; });
      require(same != source->parts.end() && format_info(same->format).numeric == format_info(part.format).numeric,
              which + "and its bypass '" + source->name + "' differ in part '" + part.name + "'");
    }
  }

  void check_param(const Param& param) const {
    const std::string which = "param '" + param.name + "' ";
    const ParamValue& value = param.default_value;
    double number = 0;
    switch (param.type) {
      case ParamType::boolean:
        require(std::holds_alternative<bool>(value), which + "needs true or false as its default");
        return;
      case ParamType::choice:
        require(std::holds_alternative<std::string>(value) &&
                    std::find(param.choices.begin(), param.choices.end(), std::get<std::string>(value)) !=
                        param.choices.end(),
                which + "needs one of its choices as its default");
        return;
      case ParamType::integer:
        require(std::holds_alternative<int64_t>(value), which + "needs an integer default");
        number = static_cast<double>(std::get<int64_t>(value));
        break;
      case ParamType::real:
        require(std::holds_alternative<double>(value), which + "needs a real default");
        number = std::get<double>(value);
        break;
    }
    require((!param.minimum || number >= *param.minimum) && (!param.maximum || number <= *param.maximum),
            which + "has a default that is out of its range");
  }

  /// With the defaults, and with each choice of each param in turn.
  void check_reads() const {
    ParamSet chosen;
    for (const Param& param : type_.params) chosen.set(param, param.default_value);
    const auto within = [&] { return contains(type_.reads, type_.reads_of(chosen)); };
    require(within(), "reads more with its default params than it declares to read at all");
    for (const Param& param : type_.params) {
      for (const std::string& choice : param.choices) {
        chosen.set(param, choice);
        require(within(), "reads more with " + param.name + " = " + choice + " than it declares to read at all");
      }
      chosen.set(param, param.default_value);
    }
  }

  const PassType& type_;
};

}  // namespace

const Port* PassType::find_port(std::string_view port, Direction direction) const {
  const auto found = std::find_if(ports.begin(), ports.end(), [&](const Port& candidate) {
    return candidate.name == port && candidate.direction == direction;
  });
  return found == ports.end() ? nullptr : &*found;
}

const Param* PassType::find_param(std::string_view param) const {
  const auto found =
      std::find_if(params.begin(), params.end(), [&](const Param& candidate) { return candidate.name == param; });
  return found == params.end() ? nullptr : &*found;
}

void PassRegistry::add(PassType type) {
  TableCheck(type).run();
  std::string name = type.name;
  if (!types_.try_emplace(name, std::move(type)).second)
    throw Error(ExitCode::run_failed, "pass type '" + name + "' is registered twice");
}

const PassType* PassRegistry::find(std::string_view name) const {
  const auto found = types_.find(name);
  return found == types_.end() ? nullptr : &found->second;
}

std::vector<std::string> PassRegistry::names() const {
  std::vector<std::string> result;
  for (const auto& entry : types_) result.push_back(entry.first);
  return result;
}

}  // namespace lightloom
