#include "framework/stability/figure.hpp"

#include <utility>

namespace lightloom::stability {

bool holds(const Figure& figure) {
  switch (figure.relation) {
    case Relation::at_most:
      return figure.value <= figure.threshold;
    case Relation::at_least:
      return figure.value >= figure.threshold;
    case Relation::equal:
      return figure.value == figure.threshold;
  }
  return false;
}

std::string to_string(Relation relation) {
  return relation == Relation::at_most ? "<=" : relation == Relation::at_least ? ">=" : "=";
}

Figure at_most(std::string what, double value, double threshold, std::string unit) {
  return {std::move(what), value, Relation::at_most, threshold, std::move(unit)};
}

Figure at_least(std::string what, double value, double threshold, std::string unit) {
  return {std::move(what), value, Relation::at_least, threshold, std::move(unit)};
}

Figure equal(std::string what, double value, double threshold, std::string unit) {
  return {std::move(what), value, Relation::equal, threshold, std::move(unit)};
}

Figure none(std::string what, double count) {
  return equal(std::move(what), count, 0);
}

}  // namespace lightloom::stability
