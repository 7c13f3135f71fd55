#include "claims/claim.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>

#include "io/error.hpp"
#include "io/nearest.hpp"

namespace bitshade::claims {

std::string_view name_of(verdict v) {
  switch (v) {
    case verdict::holds:
      return "holds";
    case verdict::holds_if:
      return "holds if";
    case verdict::fails:
      return "fails";
    case verdict::undecidable:
      return "undecidable here";
  }
  return "";
}

verdict outcome::result() const {
  const auto all_held = [](const std::vector<check>& checks) {
    return std::all_of(checks.begin(), checks.end(), [](const check& c) { return c.held; });
  };
  if (!undecidable.empty()) return verdict::undecidable;
  if (all_held(claimed)) return verdict::holds;
  return !conditional.empty() && all_held(conditional) ? verdict::holds_if : verdict::fails;
}

void outcome::add(std::string name, double value, std::string unit, bool timed) {
  figures.push_back({std::move(name), value, std::move(unit), timed});
}

void outcome::limit(std::string text, double measured, double predicted) {
  bounds.push_back({std::move(text), measured, predicted});
}

double outcome::operator[](std::string_view name) const {
  for (const figure& f : figures)
    if (f.name == name) return f.value;
  throw std::out_of_range("no figure '" + std::string(name) + "'");
}

bool outcome::none_in(const hunt_result& hunt, const std::string& name) {
  add(name + ": cases", static_cast<double>(hunt.admissible));
  add(name + ": counterexamples", static_cast<double>(hunt.refuting));
  if (!hunt.found) return true;
  add(name + ": largest excess", hunt.largest_excess);
  counterexamples.push_back(
      {text_of(*hunt.smallest), text_of(*hunt.found), hunt.steps, hunt.to_the_end, hunt.numbers});
  return false;
}

std::vector<claim> claims_named(const std::vector<std::string>& ids) {
  std::vector<claim> chosen;
  const auto& all = all_claims();
  for (const std::string& id : ids) {
    const bool known =
        std::any_of(all.begin(), all.end(), [&](const claim& c) { return id == c.id; });
    if (known) continue;
    std::vector<std::string_view> names;
    for (const claim& c : all) names.push_back(c.id);
    const std::string_view meant = nearest(id, names);
    throw usage_error("there is no claim '" + id + "': known are " + all.front().id + " to " +
                      all.back().id +
                      (meant.empty() ? "" : "; did you mean '" + std::string(meant) + "'?"));
  }
  for (const claim& c : all)
    if (ids.empty() || std::find(ids.begin(), ids.end(), c.id) != ids.end()) chosen.push_back(c);
  return chosen;
}

std::vector<replayed_case> replay(const claim& c, const method& m, std::string_view numbers) {
  if (c.trials.empty())
    throw usage_error(std::string("claim ") + c.id +
                      " is measured on pictures or times and has no single case to replay");
  std::vector<replayed_case> all;
  std::optional<usage_error> first;
  for (const trial* t : c.trials) {
    try {
      sample given = parse_sample(t->names, numbers);
      evaluation found = t->evaluate(m, given);
      all.push_back({t, std::move(given), std::move(found)});
    } catch (const usage_error& e) {
      if (!first) first = e;
    }
  }
  if (all.empty()) throw *first;
  return all;
}

}  // namespace bitshade::claims
