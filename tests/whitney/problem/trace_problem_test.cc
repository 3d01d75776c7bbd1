// SPDX-License-Identifier: GPL-3.0-or-later
#include <whitney/problem/trace_problem.h>

#include <gtest/gtest.h>

#include <coxeter/base/error.h>
#include <whitney/io/read_problem.h>

namespace whitney {
namespace {

Problem circle(const char* more = "") {
  return parse_problem(std::string(R"({"variables": ["x","y"], "equations": ["x^2+y^2-1"], "box": [[-2,2],[-2,2]],
                                       "triangulation": {"edge_length": 0.2})") +
                           more + "}",
                       "p");
}

TEST(TraceProblem, TheMeshIsReadyBeforeItsTopology) {
  TraceProblemOptions options;
  int calls = 0;
  options.mesh_ready = [&](const TracedProblem& traced) {
    ++calls;
    EXPECT_GT(traced.mesh.num_simplices(), 10u);
    EXPECT_TRUE(traced.report.topology.f_vector.empty());
  };
  const TracedProblem traced = trace_problem(circle(), options);
  EXPECT_EQ(calls, 1);
  EXPECT_EQ(traced.outcome, TracedProblem::Outcome::kTraced);
  EXPECT_TRUE(traced.report.topology.is_closed_manifold());
  EXPECT_EQ(traced.report.topology.components, 1u);
  EXPECT_TRUE(traced.report.seeds.searched);
}

TEST(TraceProblem, NothingFoundIsAnOutcome) {
  const Problem empty =
      parse_problem(R"({"variables": ["x","y"], "equations": ["x^2+y^2+1"], "box": [[-2,2],[-2,2]]})", "p");
  const TracedProblem traced = trace_problem(empty);
  EXPECT_EQ(traced.outcome, TracedProblem::Outcome::kNothingFound);
  EXPECT_NE(traced.explanation.find("no point of the manifold"), std::string::npos);
}

TEST(TraceProblem, MemoryStopsTheTraceAndTheMeshOfWhatWasFoundIsThere) {
  TraceProblemOptions options;
  options.run.memory_limit = 1;
  options.edge_length = 1e-4;
  const TracedProblem traced = trace_problem(circle(), options);
  EXPECT_EQ(traced.report.stop_reason, StopReason::kMemoryLimit);
  EXPECT_TRUE(traced.report.stopped());
}

TEST(TraceProblem, RefusesWhatIsNoZeroSet) {
  EXPECT_THROW(trace_problem(parse_problem(R"({"named": {"name": "klein_bottle"}})", "p")), InvalidInput);
}

}  // namespace
}  // namespace whitney
