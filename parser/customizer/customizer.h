#pragma once
// Comments that describe parameters: OpenSCAD's customizer.
//
//     /* [Stone] */
//     // carat weight
//     carat = 0.5;  // [0.25:0.25:3]
//
// A variable of the main file that is set to a literal before the first '{'
// is a parameter. The comment behind it says which values it may take, the
// line above it describes it, and the last /* [group] */ above it groups it.

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "parser/ast.h"

namespace lamina {

struct ParameterComment {
  bool is_parameter = false;
  bool has_group = false;
  std::string group;
  std::string description;  // empty: none
  // The comment behind it as an expression in OpenSCAD's notation, `""` where
  // there is none or it makes no sense: `[0.25 : 0.25 : 3]`, `["a", "b"]`.
  std::string values = "\"\"";
};

// The values that the comment lets a parameter have, as the customizer of
// OpenSCAD 2026 reads it. The parameter's own value is always one of them.
struct ParameterRule {
  struct Choice {
    std::variant<double, std::string> value;
    std::string label;
  };
  std::vector<Choice> choices;  // none: all
  // They bound a number, and each number in a vector.
  std::optional<double> least;
  std::optional<double> greatest;
  std::optional<double> step;
  std::optional<std::size_t> most_bytes;  // of a text

  // The number itself, or the limit that it is beyond.
  double nearest(double number) const;
};

// Whether the customizer lets a parameter with this rule have the value. What
// is not a literal may be anything.
bool keeps_rule(const ast::Expr& value, const ParameterRule& rule);

class Customizer {
 public:
  // Reads the comments of a program, which must outlive the result. Cost: one
  // pass over the text.
  static Customizer read(const ast::Program& program);

  // assignment  a statement of the program that holds an ast::Assignment
  ParameterComment comment_of(const ast::Statement& assignment) const;

  // Nothing for what OpenSCAD 2026 does not show: a variable that is no
  // parameter, one of the group "Hidden", one whose value is neither a truth
  // value, a number, a text nor a vector of one to four numbers.
  std::optional<ParameterRule> rule_of(const ast::Statement& assignment) const;

 private:
  struct Group {
    std::string name;
    std::uint32_t line;
  };

  explicit Customizer(const Source& source) : source_(source) {}
  std::size_t skip_comment(std::size_t place, std::uint32_t& line);
  bool is_parameter(const ast::Statement& assignment) const;
  // The comment behind it as an expression in `arena`; null: none.
  const ast::Expr* values_of(const ast::Statement& assignment,
                             Arena& arena) const;
  const std::string* group_of(const ast::Statement& assignment) const;
  void scan();

  const Source& source_;
  std::vector<Group> groups_;
  std::uint32_t end_line_ = 0;  // parameters stand above it
};

// A parameter of a design, as the customizer shows it.
struct CustomizerEntry {
  std::string name;
  std::string value;  // as an expression: `0.5`, `"round"`, `[1, 2]`
  ParameterComment comment;
};

// In the order of the design. A variable that is set more than once stands in
// its first place and has its last value.
std::vector<CustomizerEntry> list_parameters(const ast::Program& program);

// By the name of a parameter, a comment behind it that is one word of
// MakerWorld's customizer: `// color`, `// font`, or `// hidden`.
std::map<std::string, std::string> widgets_of(const ast::Program& program);

// All parameters with their rules as OpenSCAD 2026 exports them: what `-o
// x.param` writes.
//
// title  the name of the design
std::string parameters_json(const ast::Program& program,
                            const std::string& title);

}  // namespace lamina
