// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/expression.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <utility>

#include <coxeter/base/error.h>
#include <whitney/functions/expression_lowering.h>
#include <whitney/functions/expression_parser.h>

namespace whitney {
namespace {

using namespace symbolic;

class CompiledModel : public Function::Model {
 public:
  explicit CompiledModel(CompiledMap map) : map_(std::move(map)) {}
  int ambient_dim() const override { return map_.values.num_inputs(); }
  int codim() const override { return map_.values.num_outputs(); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    map_.values.run_batch(points, values);
  }
  void jacobian(std::span<const double> point, std::span<double> jacobian, double) const override {
    map_.jacobian.run_batch(point, jacobian);
  }

 private:
  CompiledMap map_;
};

}  // namespace

void check_variables(std::span<const std::string> variables) {
  for (std::size_t i = 0; i < variables.size(); ++i) {
    const std::string& name = variables[i];
    if (name.empty() || !is_letter(name[0]) ||
        !std::all_of(name.begin(), name.end(), [](char c) { return is_letter(c) || is_digit(c); })) {
      throw InvalidInput("variable '" + name + "': a name is made of letters, digits and _, and begins with no digit");
    }
    if (name == kPi || find_function(name)) throw InvalidInput("variable '" + name + "': the name is reserved");
    if (std::find(variables.begin(), variables.begin() + i, name) != variables.begin() + i) {
      throw InvalidInput("variable '" + name + "' is named twice");
    }
  }
}

CompiledMap compile(std::span<const std::string> variables, std::span<const std::string> expressions) {
  if (variables.empty()) throw InvalidInput("there are no variables");
  if (expressions.empty()) throw InvalidInput("there are no expressions");
  check_variables(variables);
  const std::lock_guard lock(ginac_mutex());
  Symbols symbols(variables);
  MapCompiler compiler(symbols);
  for (const std::string& text : expressions) {
    on_expression(text, [&] { compiler.add(parse(text, symbols).e); });
  }
  return compiler.build();
}

Function make_function(CompiledMap map) {
  const int d = map.values.num_inputs(), k = map.values.num_outputs();
  if (k < 1) throw InvalidInput("the map has no components");
  if (map.jacobian.num_inputs() != d || map.jacobian.num_outputs() != k * d) {
    throw InvalidInput("the Jacobian does not fit the map");
  }
  return Function(std::make_shared<CompiledModel>(std::move(map)));
}

Function parse_equations(std::span<const std::string> variables, std::span<const std::string> equations) {
  if (equations.size() > variables.size()) {
    throw InvalidInput(std::to_string(equations.size()) + " equations in " + std::to_string(variables.size()) +
                       " variables: there must not be more equations than variables");
  }
  return make_function(compile(variables, equations));
}

double parse_constant(std::string_view expression) {
  const std::lock_guard lock(ginac_mutex());
  return on_expression(expression, [&] {
    Symbols symbols({});
    return parse(expression, symbols).constant.value();
  });
}

}  // namespace whitney
