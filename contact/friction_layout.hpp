#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/contact_mode.hpp"
#include "core/state.hpp"

namespace arcwall {

/// The history of contacts with friction: what each of them does, and where it began to. The equations are smooth
/// functions of the state and of these constants.
class FrictionLayout final : public Layout {
 public:
  /// Of one contact; of an open one nothing counts.
  struct Contact {
    ContactMode mode = ContactMode::open;
    double anchor = 0.0;   ///< where it sticks, by Candidate::place() [length]
    double touched = 0.0;  ///< where it closed, likewise [length]

    template <typename Archive>
    void serialize(Archive& archive) {
      archive(mode, anchor, touched);
    }
  };

  /// One entry a contact.
  explicit FrictionLayout(std::vector<Contact> contacts) : contacts_(std::move(contacts)) {}

  const std::vector<Contact>& contacts() const { return contacts_; }
  const Contact& operator[](std::size_t contact) const { return contacts_[contact]; }

 private:
  std::vector<Contact> contacts_;
};

}  // namespace arcwall
