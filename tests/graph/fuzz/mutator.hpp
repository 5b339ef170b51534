#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace lightloom::fuzz {

using Random = std::mt19937_64;

/// Any of a list that is not empty.
template <class T>
const T& any(const std::vector<T>& list, Random& random) {
  return list[random() % list.size()];
}

/// Spoils graph files: most changes keep the JSON whole, so that they reach the phases behind the parser.
class Mutator {
 public:
  /// `corpus`: what parts are borrowed from. `names`: words that mean something, pass types for instance.
  Mutator(std::vector<std::string> corpus, std::vector<std::string> names);

  /// Mostly one or two changes, up to five.
  [[nodiscard]] std::string mutate(const std::string& text, Random& random) const;

 private:
  using Tokens = std::vector<std::string>;
  void change(Tokens& tokens, Random& random) const;
  void change_member(Tokens& tokens, Random& random) const;
  void change_string(Tokens& tokens, Random& random) const;
  void break_syntax(Tokens& tokens, Random& random) const;

  std::vector<Tokens> corpus_;
  std::vector<std::string> names_;
};

}  // namespace lightloom::fuzz
