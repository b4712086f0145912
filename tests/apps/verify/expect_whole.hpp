#pragma once

#include <gtest/gtest.h>

#include "apps/output/exit_status.hpp"
#include "apps/verify/verify.hpp"
#include "tests/apps/traced_deck.hpp"
#include "tests/apps/verify/stored_files_of.hpp"

namespace arcwall::test {

/// Expects that `verify` finds nothing wrong in a run.
inline void expect_verified(const TracedDeck& traced) {
  const verify::Verdict verdict =
      verify::verify(traced.model(), traced.record(), verify::stored_files_of(traced.record()), "checkpoint");
  EXPECT_FALSE(verdict.findings.first().has_value()) << verify::to_text(*verdict.findings.first());
}

/// The same, and that its last branch ends where it should.
inline void expect_whole(const TracedDeck& traced) {
  EXPECT_EQ(exit_status(traced.record().branches.back().end.value().reason), ExitStatus::success);
  expect_verified(traced);
}

}  // namespace arcwall::test
