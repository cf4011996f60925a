#pragma once
// Random programs for comparing parsers.

#include <random>
#include <string>

namespace lamina {

// Writes programs that hold every construct of the language, oddly spaced.
// They are correct, and evaluating them is harmless: all stands in modules
// and functions that nothing calls.
class RandomPrograms {
 public:
  explicit RandomPrograms(unsigned seed) : random_(seed) {}

  // A program of `count` definitions.
  std::string program(int count);

  // `program` with a token or a few characters replaced, in most cases no
  // program any more.
  std::string damage(std::string program);

 private:
  int below(int count);  // uniform in 0 … count - 1
  bool chance(int percent) { return below(100) < percent; }
  template <std::size_t N>
  const char* any(const char* const (&choices)[N]) {
    return choices[below(static_cast<int>(N))];
  }

  std::string blank();
  std::string name();
  std::string string();
  std::string literal();
  std::string arguments(int depth);
  std::string parameters(int depth);
  std::string operand(int depth);
  std::string vector(int depth);
  std::string elements(int depth);
  std::string elements_or_expression(int depth);
  std::string expression(int depth);
  std::string child(int depth);
  std::string instantiation(int depth);
  std::string statement(int depth);

  std::mt19937 random_;
};

}  // namespace lamina
