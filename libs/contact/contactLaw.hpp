// Family of contact laws: energy psi(g) per area of two surfaces with the gap g.
//     g = distance - thickness
// The thickness is an offset: surfaces touch when their meshes are at this distance. It represents the layers outside
// the meshes (half the membrane and the glycocalyx, on each side), and keeps the meshes apart where the force is large.
// symbol    | meaning                                          | unit
// g         | gap between the surfaces                         | m
// thickness | distance of the meshes at which the gap is 0     | m
// psi       | energy per area; infinite at g <= 0, 0 at reach  | J/m^2
//
// A law is a struct that derives from ContactLaw, with its coefficients, schema(), reach() and at(g). psi must be C2
// for all g > 0, so that forces have a continuous derivative where a contact begins. barrier.hpp is the model to
// follow.
#pragma once
#include <optional>

#include "core/settings.hpp"

namespace corpuscle::contact {

class ContactLaw {
  public:
    static constexpr const char* familyName = "contact law";
    double thickness = 0;  // m

    struct Value {
        double energy = 0, slope = 0, curvature = 0;  // psi [J/m^2], dpsi/dg [J/m^3], d2psi/dg2 [J/m^4]
    };

    ContactLaw() = default;
    ContactLaw(const ContactLaw&) = default;
    ContactLaw& operator=(const ContactLaw&) = default;
    virtual ~ContactLaw() = default;

    virtual double reach() const = 0;  // gap [m] from which on psi = 0
    virtual Value at(double gap) const = 0;
    virtual std::optional<double> restGap() const { return {}; }  // where psi is least; empty: no attraction
    double range() const { return thickness + reach(); }          // distance of the meshes from which on psi = 0
};

}  // namespace corpuscle::contact
