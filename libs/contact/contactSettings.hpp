// constant/contact.yaml: contact of membranes with each other, with themselves and with walls.
//
//     law: {type: barrier, reach: 0.1 um, strength: 1 uN/m}
//     self: true
//     walls: true
#pragma once
#include "contact/contactLaw.hpp"
#include "core/registry.hpp"

namespace corpuscle::contact {

struct ContactSettings {
    Choice<ContactLaw> law;
    bool self = true;   // also of a membrane with itself
    bool walls = true;  // also of membranes with walls
    static const Schema<ContactSettings>& schema();
};

}  // namespace corpuscle::contact
