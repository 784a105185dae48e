// judge/rational_form.h: polynomials in t on [0,1] as forms sum c_i (1-t)^(n-i) t^i. A point that
// moves from A to B has the coefficients (A, B), products are convolutions, and the values at t = 0
// and t = 1 are the first and the last coefficient: there is no division.
#pragma once

#include <array>
#include <cstddef>

namespace foretouch::oracle {

/// A form of formal degree N; leading and trailing coefficients may be zero.
template <typename S, std::size_t N>
struct Form {
  std::array<S, N + 1> c{};
};

template <typename S, std::size_t N>
Form<S, N> operator+(const Form<S, N>& a, const Form<S, N>& b) {
  Form<S, N> sum;
  for (std::size_t i = 0; i <= N; ++i) sum.c[i] = a.c[i] + b.c[i];
  return sum;
}
template <typename S, std::size_t N>
Form<S, N> operator-(const Form<S, N>& a, const Form<S, N>& b) {
  Form<S, N> difference;
  for (std::size_t i = 0; i <= N; ++i) difference.c[i] = a.c[i] - b.c[i];
  return difference;
}
template <typename S, std::size_t N, std::size_t M>
Form<S, N + M> operator*(const Form<S, N>& a, const Form<S, M>& b) {
  Form<S, N + M> product;
  for (std::size_t i = 0; i <= N; ++i) {
    for (std::size_t j = 0; j <= M; ++j) product.c[i + j] = product.c[i + j] + a.c[i] * b.c[j];
  }
  return product;
}

template <typename S, std::size_t N>
using Form3 = std::array<Form<S, N>, 3>;

template <typename S, std::size_t N>
Form3<S, N> operator-(const Form3<S, N>& a, const Form3<S, N>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <typename S, std::size_t N, std::size_t M>
Form<S, N + M> dot(const Form3<S, N>& a, const Form3<S, M>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <typename S, std::size_t N, std::size_t M>
Form3<S, N + M> cross(const Form3<S, N>& a, const Form3<S, M>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

}  // namespace foretouch::oracle
