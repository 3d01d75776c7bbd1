// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/functions/domain.h>

#include <algorithm>
#include <memory>
#include <utility>

#include <coxeter/base/error.h>

namespace whitney {
namespace {

class StackedModel : public Function::Model {
 public:
  StackedModel(Function f, Domain domain, std::vector<int> inequalities)
      : f_(std::move(f)), domain_(std::move(domain)), inequalities_(std::move(inequalities)) {}

  int ambient_dim() const override { return f_.ambient_dim(); }
  int codim() const override { return f_.codim() + static_cast<int>(inequalities_.size()); }
  void evaluate(std::span<const double> points, std::span<double> values) const override {
    const std::size_t d = ambient_dim(), k = f_.codim(), rows = codim(), m = domain_.num_given();
    const std::size_t count = points.size() / d;
    std::vector<double> f(count * k), g(count * m);
    f_.evaluate(points, f);
    if (m > 0) domain_.given()->evaluate(points, g);
    for (std::size_t i = 0; i < count; ++i) {
      std::copy_n(f.begin() + i * k, k, values.begin() + i * rows);
      for (std::size_t r = k; r < rows; ++r) {
        const int j = inequalities_[r - k];
        values[i * rows + r] = domain_.is_box_side(j) ? domain_.box_value(j, &points[i * d]) : g[i * m + j];
      }
    }
  }
  void jacobian(std::span<const double> point, std::span<double> jacobian, double length_scale) const override {
    const std::size_t d = ambient_dim(), k = f_.codim();
    f_.jacobian(point, jacobian.first(k * d), length_scale);
    for (std::size_t r = 0; r < inequalities_.size(); ++r) {
      const std::vector<double> row = domain_.gradient(inequalities_[r], point, length_scale);
      std::copy(row.begin(), row.end(), jacobian.begin() + (k + r) * d);
    }
  }

 private:
  Function f_;
  Domain domain_;
  std::vector<int> inequalities_;
};

}  // namespace

Domain::Domain(int ambient_dim, std::optional<Function> inequalities, std::optional<Box> box)
    : ambient_dim_(ambient_dim), given_(std::move(inequalities)), box_(std::move(box)) {
  const auto d = static_cast<std::size_t>(ambient_dim);
  if (given_) {
    if (given_->ambient_dim() != ambient_dim)
      throw InvalidInput("the inequalities are defined on R^" + std::to_string(given_->ambient_dim()) + ", not on R^" +
                         std::to_string(ambient_dim));
    num_given_ = given_->codim();
  }
  if (!box_) return;
  if (box_->lower.size() != d || box_->upper.size() != d)
    throw InvalidInput("the box must have " + std::to_string(d) + " lower and upper bounds");
  for (std::size_t c = 0; c < d; ++c)
    if (!(box_->lower[c] < box_->upper[c]))
      throw InvalidInput("the box is empty along coordinate " + std::to_string(c + 1));
}

void Domain::set_mask(const double* x, const double* given, std::uint64_t* mask) const {
  std::fill_n(mask, num_words(), std::uint64_t{0});
  auto set = [&](int j, bool violated) { mask[j / 64] |= std::uint64_t{violated} << (j % 64); };
  for (int j = 0; j < num_given_; ++j) set(j, given[j] < 0);
  if (!box_) return;
  for (int c = 0; c < ambient_dim_; ++c) {
    set(num_given_ + 2 * c, x[c] < box_->lower[c]);
    set(num_given_ + 2 * c + 1, x[c] > box_->upper[c]);
  }
}

std::vector<double> Domain::values(std::span<const double> x) const {
  std::vector<double> values(num_inequalities());
  if (given_) given_->evaluate(x, std::span(values).first(num_given_));
  for (int j = num_given_; j < num_inequalities(); ++j) values[j] = box_value(j, x.data());
  return values;
}

bool Domain::contains(std::span<const double> x, std::span<const double> slack) const {
  const std::vector<double> g = values(x);
  for (std::size_t j = 0; j < g.size(); ++j)
    if (!(g[j] >= (slack.empty() ? 0.0 : -slack[j]))) return false;
  return true;
}

std::vector<double> Domain::gradient(int j, std::span<const double> x, double length_scale) const {
  std::vector<double> row(ambient_dim_, 0.0);
  if (is_box_side(j)) {
    const int side = j - num_given_;
    row[side / 2] = side % 2 == 0 ? 1 : -1;
    return row;
  }
  std::vector<double> jacobian(std::size_t(num_given_) * ambient_dim_);
  given_->jacobian(x, jacobian, length_scale);
  std::copy_n(jacobian.begin() + std::ptrdiff_t(j) * ambient_dim_, ambient_dim_, row.begin());
  return row;
}

Function Domain::with_equations(const Function& f, std::vector<int> inequalities) const {
  if (inequalities.empty()) return f;
  return Function(std::make_shared<StackedModel>(f, *this, std::move(inequalities)));
}

std::string Domain::name(int j) const {
  if (!is_box_side(j)) return "inequality " + std::to_string(j);
  const int side = j - num_given_;
  return std::string("box: ") + (side % 2 == 0 ? "lower" : "upper") + " side of coordinate " +
         std::to_string(side / 2 + 1);
}

}  // namespace whitney
