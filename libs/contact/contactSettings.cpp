#include "contact/contactSettings.hpp"

namespace corpuscle::contact {

const Schema<ContactSettings>& ContactSettings::schema() {
    static const Schema<ContactSettings> s =
        Schema<ContactSettings>("contact", "constant/contact.yaml: what keeps membranes apart")
            .model("law", &ContactSettings::law, "energy per area of two surfaces by their gap")
            .boolean("self", &ContactSettings::self, "whether a membrane has contact with itself", {.fallback = "true"})
            .boolean("walls", &ContactSettings::walls, "whether membranes have contact with walls",
                     {.fallback = "true"})
            .atRestart(AtRestart::noted, {"law", "self", "walls"});
    return s;
}

}  // namespace corpuscle::contact
