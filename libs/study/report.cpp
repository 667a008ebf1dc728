#include "study/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <thread>

#include "core/atomicFile.hpp"
#include "core/wallClock.hpp"

namespace corpuscle::study {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t mostCurves = 12;  // in one plot; more are drawn as points without lines, in one colour

std::string escaped(const std::string& text) {
    std::string safe;
    for (const char c : text) switch (c) {
            case '&':
                safe += "&amp;";
                break;
            case '<':
                safe += "&lt;";
                break;
            case '>':
                safe += "&gt;";
                break;
            case '"':
                safe += "&quot;";
                break;
            default:
                safe += c;
        }
    return safe;
}

// Text in single quotes of gnuplot, in which only the quotes themselves have a special meaning.
std::string forGnuplot(const std::string& text) {
    std::string safe;
    for (const char c : text) safe += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
    return "'" + safe + "'";
}

struct Curve {
    std::string title;  // values of the other parameters
    std::vector<const SummaryRow*> rows;
};

// Cases that differ in parameter x only are one curve.
std::vector<Curve> curvesOver(const Summary& summary, std::size_t x, std::size_t result) {
    std::map<std::string, Curve> curves;
    std::vector<std::string> order;
    for (const SummaryRow& row : summary.rows) {
        if (row.status->state != CaseState::done || !std::isfinite(row.results[result].estimate.value)) continue;
        std::string title;
        for (std::size_t k = 0; k < row.texts.size(); ++k)
            if (k != x && !summary.parameters[k].follows)
                title += fmt::format("{}{} {}", title.empty() ? "" : ", ", summary.parameters[k].name, row.texts[k]);
        if (!curves.contains(title)) order.push_back(title), curves[title].title = title;
        curves[title].rows.push_back(&row);
    }
    std::vector<Curve> all;
    all.reserve(order.size());
    for (const std::string& title : order) all.push_back(std::move(curves[title]));
    for (Curve& curve : all)
        std::stable_sort(curve.rows.begin(), curve.rows.end(),
                         [&](const SummaryRow* a, const SummaryRow* b) { return a->numbers[x] < b->numbers[x]; });
    return all;
}

std::string plotScript(const Summary& summary, std::size_t x, std::size_t result, const fs::path& file) {
    const ParameterColumn& parameter = summary.parameters[x];
    const auto& [name, settings] = summary.results[result];
    std::vector<Curve> curves = curvesOver(summary, x, result);
    bool isLine = curves.size() <= mostCurves;
    isLine = isLine && std::any_of(curves.begin(), curves.end(), [](const Curve& c) { return c.rows.size() > 1; });
    if (curves.empty()) return {};
    std::string blocks, plots;
    const bool hasError = settings->statistic->hasError();
    if (!isLine) {  // all cases as one set of points
        for (std::size_t k = 1; k < curves.size(); ++k)
            curves[0].rows.insert(curves[0].rows.end(), curves[k].rows.begin(), curves[k].rows.end());
        curves.resize(1);
        curves[0].title.clear();
    }
    for (std::size_t k = 0; k < curves.size(); ++k) {
        blocks += fmt::format("$curve{} << END\n", k);
        for (const SummaryRow* row : curves[k].rows) {
            const Estimate& e = row->results[result].estimate;
            blocks += fmt::format("{:.10g} {:.10g} {:.10g}\n", row->numbers[x], e.value,
                                  std::isfinite(e.error) ? e.error : 0.0);
        }
        blocks += "END\n";
        plots += fmt::format("{}$curve{} using 1:2{} with {} pt 7 ps 0.6 lw 1.5 lc {} {}",
                             k == 0 ? "plot " : ", \\\n     ", k, hasError ? ":3" : "",
                             hasError ? (isLine ? "yerrorlines" : "yerrorbars") : (isLine ? "linespoints" : "points"),
                             k + 1, curves[k].title.empty() ? "notitle" : "title " + forGnuplot(curves[k].title));
    }
    return fmt::format(
        "set terminal svg size 540,400 dynamic font 'sans-serif,15' noenhanced background '#ffffff'\n"
        "set output {}\nset key outside top center horizontal\nset grid lc rgb '#dddddd'\n"
        "set xlabel {}\nset ylabel {}\n{}set offsets graph 0.03, graph 0.03, graph 0.05, graph 0.05\n"
        "{}{}\nunset output\nreset\n",
        forGnuplot(file.string()),
        forGnuplot(parameter.name + (parameter.unit.empty() ? "" : " [" + parameter.unit + "]")), forGnuplot(name),
        parameter.isLogarithmic ? "set logscale x\n" : "", blocks, plots);
}

bool runGnuplot(const fs::path& script, const fs::path& log, const Environment& environment) {
    Process process({"gnuplot", script.string()}, log, environment, {});
    while (true) {
        if (const auto code = process.poll()) return *code == 0;
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

struct Plot {
    std::string result, parameter, file;
};

std::string plotsSection(const Summary& summary, const fs::path& scratch, const Environment& environment) {
    fs::create_directories(scratch);
    std::string script;
    std::vector<Plot> plots;
    for (std::size_t r = 0; r < summary.results.size(); ++r)
        for (std::size_t x = 0; x < summary.parameters.size(); ++x) {
            if (!summary.parameters[x].isNumber || summary.parameters[x].follows) continue;
            const fs::path file = scratch / fmt::format("{}-{}.svg", r, x);
            const std::string one = plotScript(summary, x, r, file);
            if (one.empty()) continue;
            script += one;
            plots.push_back({summary.results[r].first, summary.parameters[x].name, file.string()});
        }
    std::string html;
    if (!plots.empty()) {
        writeFileAtomically(scratch / "plots.gp", script);
        if (runGnuplot(scratch / "plots.gp", scratch / "log.gnuplot", environment))
            for (const Plot& plot : plots) {
                std::string svg = readFile(plot.file);
                if (const std::size_t begin = svg.find("<svg"); begin != std::string::npos) svg.erase(0, begin);
                html += fmt::format("<figure>{}<figcaption>{} over {}</figcaption></figure>\n", svg,
                                    escaped(plot.result), escaped(plot.parameter));
            }
        else
            html = "<p>There are no plots, since gnuplot could not be run (package gnuplot-nox).</p>\n";
    }
    std::error_code ignored;
    fs::remove_all(scratch, ignored);
    return html.empty() ? "" : "<section class=\"plots\">\n" + html + "</section>\n";
}

std::string resultText(const CaseResult& result, bool hasError) {
    if (!result.problem.empty())
        return fmt::format("<span class=\"problem\" title=\"{0}\">{0}</span>", escaped(result.problem));
    if (!std::isfinite(result.estimate.value)) return "";
    std::string text = fmt::format("{:.6g}", result.estimate.value);
    if (hasError && std::isfinite(result.estimate.error))
        text += fmt::format(" &plusmn; {:.2g}{}", result.estimate.error, result.estimate.isReliable ? "" : " *");
    return text;
}

std::string tableSection(const Summary& summary) {
    std::string head = "<th>case</th><th>status</th>";
    for (const ParameterColumn& p : summary.parameters)
        head += fmt::format("<th>{}{}</th>", escaped(p.name), p.unit.empty() ? "" : " [" + escaped(p.unit) + "]");
    for (const auto& [name, result] : summary.results)
        head += fmt::format("<th title=\"{}\">{}</th>", escaped(result->meaning()), escaped(name));
    std::string body;
    bool isDoubtful = false;
    for (const SummaryRow& row : summary.rows) {
        const std::string state = nameOf(row.status->state);
        body += fmt::format("<tr><td><a href=\"{0}\">{0}</a></td><td class=\"{1}\">{1}</td>",
                            escaped(row.status->what.name), state);
        for (std::size_t k = 0; k < row.texts.size(); ++k)
            body += fmt::format(
                "<td data-v=\"{}\">{}</td>",
                summary.parameters[k].isNumber ? fmt::format("{:.12g}", row.numbers[k]) : "",
                summary.parameters[k].isNumber ? fmt::format("{:.6g}", row.numbers[k]) : escaped(row.texts[k]));
        for (std::size_t k = 0; k < row.results.size(); ++k) {
            const CaseResult& result = row.results[k];
            const bool hasError = summary.results[k].second->statistic->hasError();
            isDoubtful = isDoubtful || (std::isfinite(result.estimate.error) && !result.estimate.isReliable);
            body += fmt::format("<td data-v=\"{:.12g}\">{}</td>", result.estimate.value, resultText(result, hasError));
        }
        body += fmt::format("<td data-v=\"{:.1f}\">{}</td></tr>\n", row.status->seconds,
                            formatDuration(row.status->seconds));
    }
    return fmt::format(
        "<div class=\"wide\"><table id=\"cases\"><thead><tr>{}<th>run "
        "time</th></tr></thead>\n<tbody>\n{}</tbody></table></div>\n{}",
        head, body,
        isDoubtful ? "<p>* The standard error is a lower bound: the series is too short for it, or drifts.</p>\n" : "");
}

std::string failuresSection(const Summary& summary) {
    std::string html;
    for (const SummaryRow& row : summary.rows)
        if (const auto& failed = row.status->record.failed; failed && row.status->state == CaseState::failed)
            html += fmt::format("<h3>{}</h3>\n<p>{} ended with code {} after {}.</p>\n<pre>{}</pre>\n",
                                escaped(row.status->what.name), escaped(failed->program), failed->code,
                                formatDuration(failed->seconds), escaped(failed->logEnd));
    return html.empty() ? "" : "<h2>Cases that failed</h2>\n" + html;
}

constexpr const char* style = R"(
body { font-family: sans-serif; line-height: 1.45; margin: 1rem auto; max-width: 76rem; padding: 0 1rem; color: #222; }
h1 { font-size: 1.5rem; } h2 { font-size: 1.2rem; } h3 { font-size: 1rem; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 1rem; }
figure { margin: 0; } figure svg { width: 100%; height: auto; } figcaption { text-align: center; font-size: 0.9rem; }
.wide { overflow-x: auto; } table { border-collapse: collapse; font-size: 0.9rem; }
th, td { border-bottom: 1px solid #ddd; padding: 0.3rem 0.7rem; text-align: right; white-space: nowrap; }
th { cursor: pointer; background: #f4f4f4; } th:first-child, td:first-child { text-align: left; }
td .problem { color: #a00; display: inline-block; max-width: 16rem; overflow: hidden; text-overflow: ellipsis;
              vertical-align: bottom; }
td.done { color: #060; } td.failed { color: #a00; font-weight: bold; } td.running, td.elsewhere { color: #05a; }
pre { background: #f4f4f4; padding: 0.6rem; overflow-x: auto; font-size: 0.8rem; } code { overflow-wrap: anywhere; }
)";

constexpr const char* script = R"(
document.querySelectorAll("#cases th").forEach((head, column) => {
  let sign = 1;
  head.addEventListener("click", () => {
    const body = document.querySelector("#cases tbody");
    const key = row => { const c = row.cells[column]; return c.dataset.v ? parseFloat(c.dataset.v) : c.textContent; };
    [...body.rows].sort((a, b) => { const x = key(a), y = key(b);
      return sign * (typeof x === "number" && typeof y === "number" ? (isNaN(x) ? 1 : isNaN(y) ? -1 : x - y)
                                                                     : String(x).localeCompare(String(y))); })
      .forEach(row => body.appendChild(row));
    sign = -sign;
  });
});
)";

}  // namespace

std::string reportPage(const Summary& summary, const ReportText& text, const fs::path& scratch,
                       const Environment& environment) {
    std::map<std::string, int> counts;
    double seconds = 0;
    for (const SummaryRow& row : summary.rows) ++counts[nameOf(row.status->state)], seconds += row.status->seconds;
    std::string states;
    for (const auto& [state, count] : counts)
        states += fmt::format("{}{} {}", states.empty() ? "" : ", ", count, state);
    std::string results;
    for (const auto& [name, result] : summary.results)
        results += fmt::format("<li><b>{}</b>: {}</li>\n", escaped(name), escaped(result->meaning()));
    std::string settings;
    for (const std::string& one : text.settings) settings += fmt::format("<li><code>{}</code></li>\n", escaped(one));
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    page += fmt::format("<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n", escaped(text.title),
                        style);
    page += fmt::format(
        "<p>{} cases of the template <code>{}</code>: {}. Run time of all programs: {}. {}, Corpuscle {}.</p>\n",
        summary.rows.size(), escaped(text.templateCase), states, formatDuration(seconds), escaped(text.date),
        escaped(text.version));
    if (!results.empty()) page += "<ul>\n" + results + "</ul>\n";
    page += plotsSection(summary, scratch, environment);
    page += "<h2>Cases</h2>\n<p>A click on a column's head sorts by it.</p>\n" + tableSection(summary);
    page += failuresSection(summary);
    if (!settings.empty()) page += "<h2>In all cases</h2>\n<ul>\n" + settings + "</ul>\n";
    return page + "<script>" + script + "</script>\n</body>\n</html>\n";
}

}  // namespace corpuscle::study
