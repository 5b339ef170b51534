#include <algorithm>

#include "framework/base/text.hpp"
#include "framework/graph/link_state.hpp"

namespace lightloom::linking {
namespace {

struct Image {
  Node* node = nullptr;
  const Port* port = nullptr;
  const PortPart* part = nullptr;
  std::string port_name;  ///< "port" for a node's own wish, "pass.port" otherwise
  std::string full_name;  ///< the same with ".part"; that of the port for a single image
};

void add_images(Node& node, const std::string& prefix, std::vector<Image>& images) {
  if (node.type == nullptr) return;
  for (const Port& port : node.type->ports) {
    if (port.direction == Direction::in) continue;
    for (const PortPart& part : port.parts) {
      const std::string name = prefix + port.name;
      images.push_back({&node, &port, &part, name, part.name.empty() ? name : name + "." + part.name});
    }
  }
}

std::string choices_text(const Image& image) {
  std::vector<std::string> names;
  for (const Format choice : storage_choices(image.part->format)) names.emplace_back(format_info(choice).name);
  return join(names, ", ");
}

bool fits(const Image& image, Format format) {
  const std::vector<Format> choices = storage_choices(image.part->format);
  return std::find(choices.begin(), choices.end(), format) != choices.end();
}

bool may_have(const Image& image, Format format) {
  return format == image.part->format || (image.port->exact_format.empty() && fits(image, format));
}

std::string full_name(const Image& image) {
  const std::string name = image.node->spec->name + "." + image.port->name;
  return image.part->name.empty() ? name : name + "." + image.part->name;
}

class FormatResolver {
 public:
  FormatResolver(Nodes& nodes, Report& report, std::vector<std::string>& notes)
      : nodes_(nodes), report_(report), notes_(notes) {}

  void apply(const FormatWish& wish) {
    const std::optional<Format> format = find_format(wish.spec.format.text);
    if (!format)
      report_.error("unknown-format", wish.spec.format.where,
                    "there is no format " + in_quotes(wish.spec.format.text) + " to store values in",
                    did_you_mean(wish.spec.format.text, format_names(), "formats"));
    const std::vector<Image> images = matches(wish);
    if (!format || images.empty()) return;
    const auto may = [&](const Image& image) { return may_have(image, *format); };
    if (std::none_of(images.begin(), images.end(), may)) return refuse(images, *format, wish);
    for (const Image& image : images) {
      if (may(image)) {
        choose(image, *format);
      } else if (fits(image, *format)) {
        notes_.push_back(full_name(image) + " stays " + std::string(format_info(image.part->format).name) + ": " +
                         image.port->exact_format);
      }
    }
  }

 private:
  std::vector<Image> matches(const FormatWish& wish) {
    std::vector<Image> all;
    if (wish.node) {
      add_images(nodes_.list[*wish.node], "", all);
    } else {
      for (Node& node : nodes_.list) add_images(node, node.spec->name + ".", all);
    }
    std::vector<std::string> names;
    for (const Image& image : all)
      if (names.empty() || names.back() != image.port_name) names.push_back(image.port_name);
    const std::string& wanted = wish.spec.values;
    std::erase_if(all, [&](const Image& image) {
      if (wish.node) return image.port_name != wanted && image.full_name != wanted;
      return !glob_match(wanted, image.port_name) && !glob_match(wanted, image.full_name);
    });
    if (all.empty()) say_unmatched(wish, names);
    return all;
  }

  void say_unmatched(const FormatWish& wish, const std::vector<std::string>& names) {
    if (!wish.node) {
      report_.error("no-match", wish.spec.values_where, in_quotes(wish.spec.values) + " matches no value",
                    did_you_mean(wish.spec.values, names, "values are named pass.port or pass.port.part"));
      return;
    }
    const Node& node = nodes_.list[*wish.node];
    if (node.type == nullptr) return;
    if (node.swapped_by) {
      notes_.push_back(*node.swapped_by + " makes '" + node.spec->name + "' a '" + node.type->name +
                       "', without output '" + wish.spec.values + "' and its format");
      return;
    }
    report_.error(
        "unknown-output", wish.spec.values_where,
        "pass '" + node.spec->name + "' of type '" + node.type->name + "' has no output " + in_quotes(wish.spec.values),
        did_you_mean(wish.spec.values, names, "its outputs"));
  }

  /// Names the one that comes nearest.
  void refuse(const std::vector<Image>& images, Format format, const FormatWish& wish) {
    const auto near =
        std::find_if(images.begin(), images.end(), [&](const Image& image) { return fits(image, format); });
    const Image& image = near != images.end() ? *near : images.front();
    const std::string which = "'" + full_name(image) + "' is " + std::string(format_info(image.part->format).name) +
                              " and cannot be stored as " + std::string(format_info(format).name);
    if (near != images.end()) {
      report_.error("exact-format", wish.spec.format.where, which + ": " + image.port->exact_format);
      return;
    }
    const bool only = storage_choices(image.part->format).size() == 1 || !image.port->exact_format.empty();
    report_.error("format-mismatch", wish.spec.format.where, which,
                  only ? "no other format holds what it does"
                       : "formats that hold the same kind of numbers in as many channels: " + choices_text(image));
  }

  static void choose(const Image& image, Format format) {
    std::erase_if(image.node->formats, [&](const auto& chosen) { return chosen.first == image.part; });
    if (format != image.part->format) image.node->formats.emplace_back(image.part, format);
  }

  Nodes& nodes_;
  Report& report_;
  std::vector<std::string>& notes_;
};

}  // namespace

void resolve_formats(Nodes& nodes, Report& report, std::vector<std::string>& notes) {
  for (Node& node : nodes.list) node.formats.clear();
  FormatResolver resolver(nodes, report, notes);
  for (const FormatWish& wish : nodes.formats) resolver.apply(wish);
}

}  // namespace lightloom::linking
