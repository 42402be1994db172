// SPDX-License-Identifier: Apache-2.0
#include "rave/experiment_report/page.hpp"

#include <fmt/format.h>

#include <iterator>

#include "plots.hpp"
#include "rave/base/markup.hpp"
#include "rave/experiment_report/answer.hpp"
#include "style.hpp"

namespace rave::experiment {
namespace {

constexpr std::size_t kMostTableRows = 100;  // of a table; all are in the CSV
constexpr std::size_t kMostFailures = 20;

class Page {
 public:
  Page(const Analysis& analysis, const std::string& version)
      : analysis_(analysis), experiment_(analysis.plan.experiment), version_(version) {}

  std::string html() && {
    head();
    for (const MetricAnalysis& metric : analysis_.metrics) section_of(metric);
    comparisons();
    failures();
    repeat();
    foot();
    return std::move(html_) + "</main>\n</html>\n";
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(html_), format, std::forward<Args>(args)...);
  }
  static std::string text(std::string_view words) { return escaped_markup(words); }

  void head() {
    const std::string title =
        experiment_.question.empty() ? *experiment_.name : experiment_.question;
    const std::string failed =
        analysis_.failed.empty() ? "" : fmt::format(", {} failed", analysis_.failed.size());
    add("<!DOCTYPE html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
        "<title>{}</title>\n<style>{}</style>\n<main>\n",
        text(title), kPageStyle);
    add("<div class=\"top\"><span><b>RAVE</b> report of an experiment</span>"
        "<span>{} · {} of {} runs{}</span></div>\n",
        text(*experiment_.name), analysis_.runs, analysis_.planned, failed);
    add("<h1>{}</h1>\n<p class=\"answer\">{}</p>\n", text(title), text(answer(analysis_)));
    if (!analysis_.as_expected()) {
      add("<p class=\"bad\">Not as the experiment file expects; see the comparisons.</p>\n");
    }
    if (analysis_.runs < analysis_.planned) {
      add("<p class=\"bad\">{} of {} runs are missing.</p>\n", analysis_.planned - analysis_.runs,
          analysis_.planned);
    }
    add("<ul class=\"chips\">");
    for (std::size_t f = 0; f < experiment_.factors.size(); ++f) chip(f);
    add("<li>{} paired seeds</li><li>{} conditions</li></ul>\n", experiment_.repetitions,
        analysis_.plan.conditions.size());
  }

  void chip(std::size_t f) {
    const auto& factor = experiment_.factors[f];
    const std::string& first = analysis_.plan.conditions.front().condition.levels[f];
    const std::string& last = analysis_.plan.conditions.back().condition.levels[f];
    add("<li>{} {} to {}{}</li>", text(*factor.name), text(first), text(last),
        factor.unit.empty() ? "" : " " + text(factor.unit));
  }

  void section_of(const MetricAnalysis& metric) {
    const auto& file = experiment_.metrics[metric.metric];
    const bool ranked = file.better != config::MetricAim::kNone;
    add("<section><h2>{}{}</h2>\n", text(metric_title(file)), ranked ? ", best first" : "");
    add("<p class=\"soft\">{}</p>\n",
        file.time_to_event ? "Median time to the event (Kaplan-Meier); runs that ended without it "
                             "count as later than their end."
                           : "Dot: mean. Bar: 95 % interval (bootstrap). Small dots: runs.");
    add("<div class=\"pair\"><div class=\"scroll\">");
    table_of(metric);
    add("</div><div>{}{}{}</div></div>\n", file.time_to_event ? "" : curve(analysis_, metric),
        file.time_to_event ? survival_plot(analysis_, metric) : interval_plot(analysis_, metric),
        heat_map(analysis_, metric));
    add("</section>\n");
  }

  void table_of(const MetricAnalysis& metric) {
    const auto& file = experiment_.metrics[metric.metric];
    const bool timed = file.time_to_event;
    add("<table><tr><th>condition</th><th>{}</th><th>{}</th><th>runs</th></tr>\n",
        timed ? "median" : "mean", timed ? "seen in" : "95 % interval");
    std::size_t shown = 0;
    for (const std::size_t c : metric.ranking) {
      if (++shown > kMostTableRows) break;
      const MetricSummary& summary = metric.summaries[c];
      const std::size_t runs = timed ? summary.times.size() : summary.values.size();
      add("<tr><td>{}</td><td class=\"strong\">{}</td><td>{}</td><td>{}{}</td></tr>\n",
          text(analysis_.plan.text_of(c)), text(centre_text(summary, timed)),
          text(spread_text(summary, timed)), runs,
          runs < static_cast<std::size_t>(experiment_.repetitions) ? " *" : "");
    }
    add("</table>\n");
    if (metric.ranking.size() > kMostTableRows) {
      add("<p class=\"soft\">All {} are in conditions.csv.</p>\n", metric.ranking.size());
    }
  }

  void comparisons() {
    if (analysis_.comparisons.empty()) {
      add("<section><h2>Comparisons</h2>\n<p class=\"soft\">The experiment file names none. "
          "Differences between conditions that are picked after the runs may be chance: name "
          "the comparison, and run with other seeds.</p></section>\n");
      return;
    }
    add("<section><h2>Comparisons named before the runs</h2>\n<p class=\"soft\">Seed by seed "
        "where both have the seed (Wilcoxon), else Mann-Whitney; times by the log-rank test. p: "
        "corrected by Holm for {} comparisons. d: mean over standard deviation of the "
        "differences.</p>\n<div class=\"scroll\"><table>"
        "<tr><th>metric</th><th class=\"left\">condition</th><th class=\"left\">against</th>"
        "<th>difference</th><th>95 % interval</th><th>d</th><th>p</th><th "
        "class=\"left\">result</th>"
        "</tr>\n",
        analysis_.comparisons.size());
    for (const ComparisonAnalysis& comparison : analysis_.comparisons) row_of(comparison);
    add("</table></div>\n");
    for (const MetricAnalysis& metric : analysis_.metrics) {
      html_ += difference_plot(analysis_, metric.metric);
    }
    add("</section>\n");
  }

  void row_of(const ComparisonAnalysis& comparison) {
    const auto& difference = comparison.difference;
    const bool paired = !comparison.differences.empty();
    add("<tr><td>{}</td><td class=\"left\">{}</td><td class=\"left\">{}</td><td "
        "class=\"strong\">{}</td>"
        "<td>{}</td><td>{}</td><td>{}</td><td class=\"left {}\">{}{}</td></tr>\n",
        text(*experiment_.metrics[comparison.metric].name),
        text(analysis_.plan.text_of(comparison.condition)),
        text(analysis_.plan.text_of(comparison.against)),
        difference ? number_text(difference->estimate) : "",
        paired ? number_text(difference->low) + " to " + number_text(difference->high) : "",
        comparison.effect ? number_text(*comparison.effect) : "",
        text(p_text(comparison.corrected)),
        comparison.as_expected() ? (comparison.expected ? "good" : "") : "bad",
        text_of(comparison.outcome),
        !comparison.expected       ? ""
        : comparison.as_expected() ? ", as expected"
                                   : std::string(", expected: ") + text_of(*comparison.expected));
  }

  void failures() {
    if (analysis_.failed.empty()) return;
    add("<section><h2>Failed runs</h2>\n<p class=\"soft\">They are missing above (*), not "
        "zero.</p>\n");
    std::size_t shown = 0;
    for (const FailedRun& failed : analysis_.failed) {
      if (++shown > kMostFailures) break;
      add("<p class=\"bad\">{}, seed {}: {}</p><pre>{}</pre>\n",
          text(analysis_.plan.text_of(failed.run.condition)), failed.run.seed, text(failed.reason),
          text(analysis_.plan.command(failed.run)));
    }
    if (analysis_.failed.size() > kMostFailures) {
      add("<p>All {} are in runs.csv.</p>\n", analysis_.failed.size());
    }
    add("</section>\n");
  }

  void repeat() {
    const MetricAnalysis& first = analysis_.metrics.front();
    add("<section><h2>Runs</h2>\n<p class=\"soft\">A run of the first and of the last condition of "
        "the first table, step for step. runs.csv has the command of every run; they are for the "
        "folder of the experiment file.</p>\n");
    for (const std::size_t c : {first.ranking.front(), first.ranking.back()}) {
      add("<pre>{}</pre>\n", text(analysis_.plan.command({c, experiment_.first_seed})));
    }
    add("</section>\n");
  }

  void foot() {
    add("<section><dl><div><dt>Version</dt><dd>rave {}</dd></div>"
        "<div><dt>Scenario</dt><dd>{}</dd></div><div><dt>Seeds</dt><dd>{} to {}, the same in every "
        "condition</dd></div><div><dt>Runs</dt><dd>{} begun, {} counted</dd></div>"
        "<div><dt>Digest of all runs</dt><dd><code>{}</code></dd></div>"
        "<div><dt>Make it again</dt><dd><code>rave sweep {}</code></dd></div></dl></section>\n",
        text(version_), text(*experiment_.scenario), experiment_.first_seed,
        experiment_.first_seed + static_cast<std::uint64_t>(experiment_.repetitions - 1),
        analysis_.runs, analysis_.runs - analysis_.failed.size(), analysis_.digest,
        text(*experiment_.name));
  }

  const Analysis& analysis_;
  const config::ExperimentFile& experiment_;
  const std::string& version_;
  std::string html_;
};

}  // namespace

std::string report_page(const Analysis& analysis, const std::string& version) {
  return Page(analysis, version).html();
}

}  // namespace rave::experiment
