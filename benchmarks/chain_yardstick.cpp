// The yardstick: Lee's frame traced by a program that can do nothing else.
//
//   chain_yardstick ELEMENTS [TIMES]
//
// traces it so often and prints the least time.
//
// Corotational beams in one loop, a block tridiagonal LDLᵀ without pivoting, two right-hand sides an iteration,
// Newton's method on a plane across the tangent: what the physics needs and no more. It finds no events and no
// stability, so its time per Newton iteration is what a general program can come near to.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

#include "benchmarks/figures.hpp"

namespace {

using Block = Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Pair = Eigen::Matrix<double, 3, 2>;  // two right-hand sides at a node

constexpr double side = 120.0, EA = 4320.0, EI = 1440.0;  // [cm], [kN], [kN cm²]
constexpr double end_down = 90.0;                         // way of the loaded point at which the path ends [cm]

// [A Cᵀ; C B], K of an element by its two nodes, and its nodal forces.
struct ElementEquations {
  Block A, B, C;
  Vector3d f1, f2;
};

double wrapped(double angle) { return angle - 2.0 * M_PI * std::nearbyint(angle / (2.0 * M_PI)); }

// Linear beam in the frame that turns with its chord (Crisfield 1991, section 7.3): e along the chord, n across it.
class CorotationalBeam {
 public:
  explicit CorotationalBeam(const Vector2d& chord) : chord_(chord), length_(chord.norm()) {}

  ElementEquations at(const Vector3d& u1, const Vector3d& u2) const {
    const Vector2d d = chord_ + u2.head<2>() - u1.head<2>();
    const double L = d.norm();
    const Vector2d e = d / L, n(-e.y(), e.x());
    const double turn = std::atan2(chord_.x() * e.y() - chord_.y() * e.x(), chord_.x() * e.x() + chord_.y() * e.y());
    const double theta1 = wrapped(u1[2] - turn), theta2 = wrapped(u2[2] - turn);
    const double k = 2.0 * EI / length_, M1 = k * (2.0 * theta1 + theta2), M2 = k * (theta1 + 2.0 * theta2);
    const double N = EA * (d.squaredNorm() - length_ * length_) / ((L + length_) * length_), h = (M1 + M2) / (L * L);

    ElementEquations out;
    const Vector2d force = N * e - h * L * n, q = (3.0 * k / L) * n;
    out.f1 << -force, M1;
    out.f2 << force, M2;
    const Eigen::Matrix2d P = (EA / length_) * e * e.transpose() + (6.0 * k / (L * L) + N / L) * n * n.transpose() +
                              h * (e * n.transpose() + n * e.transpose());
    out.A << P, q, q.transpose(), 2.0 * k;
    out.B << P, -q, -q.transpose(), 2.0 * k;
    out.C << -P, -q, q.transpose(), k;
    return out;
  }

 private:
  Vector2d chord_;
  double length_;
};

// L D Lᵀ of a 3 × 3 matrix: pivots inverted, L below the diagonal.
struct SmallLdlt {
  double d0, d1, d2, l10, l20, l21;

  explicit SmallLdlt(const Block& S) {
    d0 = 1.0 / S(0, 0);
    l10 = S(1, 0) * d0;
    l20 = S(2, 0) * d0;
    d1 = 1.0 / (S(1, 1) - l10 * S(1, 0));
    const double s21 = S(2, 1) - l20 * S(1, 0);
    l21 = s21 * d1;
    d2 = 1.0 / (S(2, 2) - l20 * S(2, 0) - l21 * s21);
  }

  template <typename Columns>
  void solve(Columns& x) const {
    x.row(1) -= l10 * x.row(0);
    x.row(2) -= l20 * x.row(0) + l21 * x.row(1);
    x.row(0) *= d0;
    x.row(1) *= d1;
    x.row(2) *= d2;
    x.row(1) -= l21 * x.row(2);
    x.row(0) -= l10 * x.row(1) + l20 * x.row(2);
  }
};

// Column and beam as one chain of nodes, pinned at both ends.
class Chain {
 public:
  explicit Chain(int elements)
      : nodes_(static_cast<std::size_t>(elements) + 1), diagonal_(nodes_), below_(nodes_ - 1), residual_(nodes_) {
    const int column = elements / 2, beam = elements - column;
    for (int k = 0; k < column; ++k) elements_.emplace_back(Vector2d(0.0, side / column));
    for (int k = 0; k < beam; ++k) elements_.emplace_back(Vector2d(side / beam, 0.0));
    loaded_ = static_cast<std::size_t>(column + beam / 5);
    factors_.reserve(nodes_);
    gains_.resize(nodes_ - 1);
  }

  std::size_t nodes() const { return nodes_; }
  std::size_t loaded() const { return loaded_; }

  // −K⁻¹ F in the first column of x, −K⁻¹ F_λ in the second.
  void solve(const std::vector<Vector3d>& u, double lambda, std::vector<Pair>& x) {
    assemble(u, lambda);
    factorize();
    for (std::size_t i = 0; i < nodes_; ++i) x[i] << -residual_[i], Vector3d::Zero();
    x[loaded_](1, 1) = -1.0;
    substitute(x);
  }

 private:
  void assemble(const std::vector<Vector3d>& u, double lambda) {
    diagonal_[0].setZero();
    residual_[0].setZero();
    for (std::size_t e = 0; e < elements_.size(); ++e) {
      const ElementEquations element = elements_[e].at(u[e], u[e + 1]);
      diagonal_[e] += element.A;
      diagonal_[e + 1] = element.B;
      below_[e] = element.C;
      residual_[e] += element.f1;
      residual_[e + 1] = element.f2;
    }
    residual_[loaded_][1] += lambda;
    below_.front().leftCols<2>().setZero();
    below_.back().topRows<2>().setZero();
    for (const std::size_t pin : {std::size_t{0}, nodes_ - 1}) {
      diagonal_[pin].leftCols<2>().setZero();
      diagonal_[pin].topRows<2>().setZero();
      diagonal_[pin].topLeftCorner<2, 2>().setIdentity();
      residual_[pin].head<2>().setZero();
    }
  }

  // S_i = D_i − G_{i−1} C_{i−1}ᵀ, G_i = C_i S_i⁻¹
  void factorize() {
    factors_.clear();
    Block S = diagonal_[0];
    for (std::size_t i = 0; i + 1 < nodes_; ++i) {
      factors_.emplace_back(S);
      Block G = below_[i].transpose();
      factors_[i].solve(G);
      gains_[i] = G.transpose();
      S = diagonal_[i + 1] - gains_[i] * below_[i].transpose();
    }
    factors_.emplace_back(S);
  }

  void substitute(std::vector<Pair>& x) const {
    for (std::size_t i = 0; i + 1 < nodes_; ++i) x[i + 1] -= gains_[i] * x[i];
    factors_.back().solve(x.back());
    for (std::size_t i = nodes_ - 1; i-- > 0;) {
      factors_[i].solve(x[i]);
      x[i] -= gains_[i].transpose() * x[i + 1];
    }
  }

  std::size_t nodes_, loaded_ = 0;
  std::vector<CorotationalBeam> elements_;
  std::vector<Block> diagonal_, below_, gains_;
  std::vector<Vector3d> residual_;
  std::vector<SmallLdlt> factors_;
};

struct Path {
  int steps = 0, iterations = 0;
  double limit = 0.0;  // first maximum of λ over the points
};

// Steps along the tangent and back to the path on a plane across it.
class PathTracer {
 public:
  explicit PathTracer(int elements)
      : chain_(elements),
        weight_(1.0 / (double(chain_.nodes()) * side * side)),
        u_(chain_.nodes(), Vector3d::Zero()),
        last_(u_),
        tangent_(u_),
        start_(u_),
        x_(chain_.nodes()) {}

  Path trace() {
    chain_.solve(u_, lambda_, x_);
    ++path_.iterations;
    while (-u_[chain_.loaded()][1] < end_down) {
      find_tangent();
      start_ = u_;
      const double from = lambda_;
      int used = 0;
      while ((used = correct(from)) == 0) length_ *= 0.5;
      ++path_.steps;
      for (std::size_t i = 0; i < u_.size(); ++i) last_[i] = u_[i] - start_[i];
      last_lambda_ = lambda_ - from;
      if (last_lambda_ > 0.0 && !turned_) path_.limit = lambda_;
      turned_ = turned_ || last_lambda_ < 0.0;
      // The tangent comes with the last factorization, one correction old.
      if (used <= 3) length_ = std::min(1.5 * length_, longest);
      if (used > 5) length_ *= 0.7;
    }
    return path_;
  }

 private:
  static constexpr double longest = 0.05, tolerance = 1e-8;
  static constexpr int most_iterations = 8;

  // The metric: mean square of the displacements over the side, and λ.
  void find_tangent() {
    double square = 0.0, along = 0.0;
    for (std::size_t i = 0; i < x_.size(); ++i) {
      square += x_[i].col(1).squaredNorm();
      along += x_[i].col(1).dot(last_[i]);
    }
    const double sense = weight_ * along + last_lambda_ >= 0.0 ? 1.0 : -1.0;
    tangent_lambda_ = sense / std::sqrt(weight_ * square + 1.0);
    for (std::size_t i = 0; i < x_.size(); ++i) tangent_[i] = tangent_lambda_ * x_[i].col(1);
  }

  // Iterations that were needed; 0 if the step is too long.
  int correct(double from) {
    for (std::size_t i = 0; i < u_.size(); ++i) u_[i] = start_[i] + length_ * tangent_[i];
    lambda_ = from + length_ * tangent_lambda_;
    for (int iteration = 1; iteration <= most_iterations; ++iteration) {
      chain_.solve(u_, lambda_, x_);
      ++path_.iterations;
      Eigen::RowVector2d across = Eigen::RowVector2d::Zero();
      for (std::size_t i = 0; i < x_.size(); ++i) across += tangent_[i].transpose() * x_[i];
      const double dlambda = -weight_ * across[0] / (weight_ * across[1] + tangent_lambda_);
      double square = 0.0;
      for (std::size_t i = 0; i < x_.size(); ++i) {
        const Vector3d step = x_[i].col(0) + dlambda * x_[i].col(1);
        u_[i] += step;
        square += step.squaredNorm();
      }
      lambda_ += dlambda;
      const double size = std::sqrt(weight_ * square + dlambda * dlambda);
      if (size < tolerance) return iteration;
      if (!(size < 1.0)) return 0;
    }
    return 0;
  }

  Chain chain_;
  double weight_;
  std::vector<Vector3d> u_, last_, tangent_, start_;
  std::vector<Pair> x_;
  double lambda_ = 0.0, last_lambda_ = 1.0, tangent_lambda_ = 0.0, length_ = 0.005;
  bool turned_ = false;
  Path path_;
};

}  // namespace

int main(int count, char** arguments) {
  const int elements = count == 2 || count == 3 ? std::atoi(arguments[1]) : 0;
  const int times = count == 3 ? std::atoi(arguments[2]) : 1;
  if (elements < 10 || times < 1) {
    std::fprintf(stderr, "usage: chain_yardstick ELEMENTS [TIMES] (10 elements or more)\n");
    return 2;
  }
  Path path;
  double used = std::numeric_limits<double>::infinity();
  for (int round = 0; round < times; ++round) {
    const double start = arcwall::bench::cpu_seconds();
    path = PathTracer(elements).trace();
    used = std::min(used, arcwall::bench::cpu_seconds() - start);
  }
  const auto print = [&](const char* figure, const char* unit, double value) {
    arcwall::bench::print_figure("lee", elements, figure, unit, value);
  };
  print("path", "s", used);
  print("points", "", path.steps);
  print("iterations", "", path.iterations);
  print("first limit", "kN", path.limit);
  print("per iteration and element", "us", 1e6 * used / (double(path.iterations) * elements));
}
