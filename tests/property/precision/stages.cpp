// Stages other than the store: no footprint found beats its bound, and how near one comes.
#include "precision/stages.hpp"

#include <cmath>

#include "bitshade/study/precision_stages.hpp"
#include "support/catch.hpp"

using namespace bitshade;
using namespace bitshade::bit_search;

namespace {

stage_question question(double deviation, int layers) {
  stage_question q;
  q.floor_deviation = deviation;
  q.layers = layers;
  q.tries = 1000;
  return q;
}

/// The share of each bound that the search reaches at these settings.
constexpr double weights_reached = 0.55, shading_reached = 0.3, evsm_reached = 0.5;

}  // namespace

TEST_CASE("rounded weights stay within their bound, and come near it") {
  for (const double floor : {1e-3, 1e-4, 9e-6}) {
    for (const int bits : {8, 12, 16}) {
      const double bound = weight_error_at(moved_share(bits), 1, floor);
      const double worst = worst_weight_error(bits, floor);
      CAPTURE(floor, bits, bound, worst, worst / bound);
      CHECK(worst <= bound);
      CHECK(worst >= weights_reached * bound);
    }
  }
}

TEST_CASE("shading in few bits stays within its bound, and comes near it") {
  for (const int layers : {1, 4}) {
    for (const int bits : {12, 16, 20}) {
      const auto q = question(0.01, layers);
      const double floor = 1e-4 * layers * layers;
      const double bound = shading_error_at(unit_roundoff(bits), 1.0 / layers, floor);
      const double worst = worst_shading_error(q, bits);
      CAPTURE(layers, bits, bound, worst, worst / bound);
      CHECK(worst <= bound);
      CHECK(worst >= shading_reached * bound);
    }
  }
}

TEST_CASE("EVSM's stored moments stay within their bound, and come near it") {
  for (const double deviation : {0.01, 0.003}) {
    for (const int bits : {12, 16, 20}) {
      const auto q = question(deviation, 1);
      const double bound = evsm_error_at(unit_roundoff(bits), 1, q.exponent, deviation);
      const double worst = worst_evsm_error(q, bits);
      CAPTURE(deviation, bits, bound, worst, worst / bound);
      CHECK(worst <= bound);
      CHECK(worst >= evsm_reached * bound);
    }
  }
}

TEST_CASE("the fewest bits of a stage lie between what breaks and what suffices") {
  for (const stage_bits& a : {weight_bits(question(0.01, 2)), shading_bits(question(0.01, 2)),
                              evsm_bits(question(0.01, 1))}) {
    CAPTURE(a.technique, a.stage, a.predicted, a.found, a.witness_error);
    CHECK(a.found <= a.predicted);
    CHECK(a.found >= a.predicted - 2);
    CHECK(a.witness_error > 1.0 / 255);
  }
}
