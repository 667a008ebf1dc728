// Reads dictionaries as the programs do, many at once: for tests that compare the reader with the JSON schemas.
//
//     readDictionaries DIR      writes the schemas into DIR, then answers standard input line by line
//
// A line {"file": "system/mesh.yaml", "text": "..."} is answered by ["problem", ...], empty where the text is accepted.
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>

#include "simulation/dictionaries.hpp"

using namespace corpuscle;

int main(int argc, char* argv[]) {
    if (argc != 2) return 1;
    simulation::writeSchemas(argv[1]);
    for (std::string line; std::getline(std::cin, line);) {
        const nlohmann::json asked = nlohmann::json::parse(line);
        const std::string file = asked.at("file");
        nlohmann::json answer = nlohmann::json::array();
        Problems problems;
        const Node node = parseDictionary(asked.at("text"), file, problems);
        if (problems.empty()) simulation::checkDictionary(file, node, problems);
        try {
            problems.throwIfAny();
        } catch (const CaseError& error) {
            for (const Problem& p : error.problems()) answer.push_back(p.text());
        }
        std::cout << answer.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) << std::endl;
    }
    return 0;
}
