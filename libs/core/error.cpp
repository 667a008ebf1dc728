#include "core/error.hpp"

#include <algorithm>
#include <tuple>

namespace corpuscle {

std::string printable(std::string text) {
    for (char& c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7F) c = '?';
    }
    return text;
}

std::string Mark::text() const {
    if (line <= 0) return file;
    return file + ":" + std::to_string(line) + ":" + std::to_string(column);
}

std::string Problem::text() const {
    std::string text = mark.text();
    if (!key.empty()) text += (text.empty() ? "" : ": ") + key;
    return text.empty() ? message : text + ": " + message;
}

namespace {
constexpr std::size_t longestKey = 160, longestMessage = 1200;
constexpr std::size_t mostKept = 10000;  // problems; those reported are the first of these by file and line

std::string joined(const std::vector<Problem>& problems, std::size_t more) {
    std::string text;
    for (const Problem& p : problems) text += (text.empty() ? "" : "\n") + p.text();
    return more ? text + "\nand " + std::to_string(more) + " more" : text;
}
}  // namespace

std::string shortened(const std::string& text, std::size_t longest) {
    if (text.size() <= longest) return text;
    const auto isInside = [&](std::size_t i) { return (static_cast<unsigned char>(text[i]) & 0xC0) == 0x80; };
    std::size_t head = longest / 2, tail = text.size() - longest / 2;
    while (head > 0 && isInside(head)) --head;
    while (tail < text.size() && isInside(tail)) ++tail;
    return text.substr(0, head) + " ... " + text.substr(tail);
}

CaseError::CaseError(std::vector<Problem> problems, std::size_t more)
    : Failure(ExitCode::invalidCase, joined(problems, more)), problems_(std::move(problems)), more_(more) {}

void Problems::add(Mark mark, std::string key, std::string message) {
    if (list_.size() == mostKept) {
        ++more_;
        return;
    }
    const auto toOneLine = [](std::string& text, std::size_t longest) {
        text = shortened(text, longest);
        for (char& c : text)
            if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    };
    toOneLine(key, longestKey), toOneLine(message, longestMessage);
    list_.push_back({std::move(mark), std::move(key), std::move(message)});
}

void Problems::throwIfAny() const {
    if (empty()) return;
    std::vector<Problem> sorted = list_;
    std::stable_sort(sorted.begin(), sorted.end(), [](const Problem& a, const Problem& b) {
        return std::tie(a.mark.file, a.mark.line) < std::tie(b.mark.file, b.mark.line);
    });
    const std::size_t shown = std::min(sorted.size(), mostShown);
    const std::size_t more = sorted.size() - shown + more_;
    sorted.resize(shown);
    throw CaseError(std::move(sorted), more);
}

namespace {
// Damerau-Levenshtein distance with adjacent transpositions (optimal string alignment).
std::size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
    for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i)
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t change = a[i - 1] == b[j - 1] ? 0 : 1;
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + change});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    return d[a.size()][b.size()];
}

std::string lowered(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}
}  // namespace

std::string nearestWord(const std::string& word, const std::vector<std::string>& allowed) {
    constexpr std::size_t longestWord = 64;
    if (word.size() > longestWord) return "";
    std::string best;
    std::size_t bestDistance = 2 + word.size() / 3;
    for (const std::string& candidate : allowed) {
        // A word that differs only in capitals is always near.
        const std::size_t distance = lowered(candidate) == lowered(word) ? 0 : editDistance(word, candidate);
        // Of two equally near words, the one with the same letters: letters are swapped more often than lost.
        const bool swapped = std::is_permutation(word.begin(), word.end(), candidate.begin(), candidate.end());
        const bool nearer = distance < bestDistance || (distance == bestDistance && !best.empty() && swapped);
        // A distance as large as the whole word would make any two short words alike.
        if (nearer && distance < std::max(word.size(), candidate.size())) {
            bestDistance = distance;
            best = candidate;
        }
    }
    return best;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& allowed) {
    const std::string nearest = nearestWord(word, allowed);
    return nearest.empty() ? "" : " Did you mean '" + nearest + "'?";
}

std::string joinWords(const std::vector<std::string>& words, const std::string& separator) {
    std::string text;
    for (const std::string& w : words) text += (&w == &words.front() ? "" : separator) + w;
    return text;
}

}  // namespace corpuscle
