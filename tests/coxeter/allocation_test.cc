// SPDX-License-Identifier: GPL-3.0-or-later
//
// Enumeration allocates nothing per element. This file replaces operator new for the whole test program, to count.
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>
#include <tests/coxeter/brute_force.h>

#include <coxeter/faces/cofaces.h>
#include <coxeter/faces/faces.h>

namespace {
std::atomic<int> g_allocations{0};
}

void* operator new(std::size_t size) {
  ++g_allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++g_allocations;
  return std::malloc(size > 0 ? size : 1);
}
void operator delete(void* p) noexcept { std::free(p); }
void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace whitney::coxeter {
namespace {

/// Allocations of a whole enumeration; -1 when it produced nothing.
int allocations(const Simplex& s, int dim) {
  const int before = g_allocations;
  int count = 0;
  auto visit = [&](const Simplex&) { ++count; };
  if (dim <= s.dim())
    for_each_face(s, dim, visit);
  else
    for_each_coface(s, dim, visit);
  return count > 0 ? g_allocations - before : -1;
}

TEST(Allocation, OfFacesIsPerCall) {
  std::mt19937 gen(1);
  for (const int k : {1, 5, 9}) EXPECT_LE(allocations(testing::random_simplex(10, 10, gen), k), 3);
  for (const int k : {1, 15, 17}) EXPECT_LE(allocations(testing::random_simplex(50, 18, gen), k), 8);
  for (const int m : {397, 399, 400}) EXPECT_LE(allocations(testing::random_simplex(400, m, gen), m - 1), 8);
  EXPECT_EQ(allocations(testing::random_simplex(10, 7, gen), 6), 0);
}

TEST(Allocation, OfCofacesIsPerCall) {
  std::mt19937 gen(2);
  for (const int l : {1, 4, 7}) EXPECT_LE(allocations(testing::random_simplex(7, 0, gen), l), 3);
  for (const int l : {394, 397, 400}) EXPECT_LE(allocations(testing::random_simplex(400, 393, gen), l), 8);
  EXPECT_EQ(allocations(testing::random_simplex(10, 7, gen), 8), 0);
}

}  // namespace
}  // namespace whitney::coxeter
