#include "schemes/caseFacts.hpp"

#include <sstream>

namespace corpuscle::schemes {

const Node* CaseFacts::find(const std::string& path) const {
    const Node* at = written;
    std::istringstream keys(path);
    for (std::string key; at && std::getline(keys, key, '.');) at = at->find(key);
    return at;
}

}  // namespace corpuscle::schemes
