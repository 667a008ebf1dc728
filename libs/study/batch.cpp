#include "study/batch.hpp"

#include <fmt/format.h>

#include <cctype>

namespace corpuscle::study {
namespace {

std::string inQuotes(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') quoted += '\\';
        quoted += c;
    }
    return quoted + '"';
}

std::string forShell(const std::string& text) {
    std::string quoted = "'";
    for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return quoted + "'";
}

}  // namespace

std::string slurmScript(const Batch& batch) {
    std::string cases, jobName;
    for (const std::string& name : batch.names) cases += forShell(name) + "\n";
    for (const char c : batch.name) jobName += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
    return fmt::format(R"(#!/bin/bash
# A job array with one case of {0} in each job. Submit it from this folder:
#
#     sbatch {8}.slurm
#     caseSweep {0} -collect           # afterwards: summary.csv and report.html
#
# Two minutes before the time limit a solver writes a checkpoint and stops; submitted again, the array goes on from
# there and passes over the cases that are done. Adapt time, memory and partition to your cluster; all cases at once is
# --array=1-{2}, at most ten at a time --array=1-{2}%10.
#SBATCH --job-name={6}
#SBATCH --array=1-{2}
#SBATCH --ntasks={3}
#SBATCH --time=24:00:00
#SBATCH --signal=B:TERM@120
#SBATCH --output="{1}/slurm-%A_%a.log"
cd "$SLURM_SUBMIT_DIR" || exit 1
CASES=(
{7})
if [ -z "$SLURM_ARRAY_TASK_ID" ]; then echo "submit this script by sbatch" >&2; exit 1; fi
exec {4} {5} -only "${{CASES[SLURM_ARRAY_TASK_ID - 1]}}" -ranks {3}
)",
                       batch.study, batch.casesFolder, batch.names.size(), batch.ranks, forShell(batch.program),
                       forShell(batch.study), jobName, cases, forShell(batch.name));
}

std::string snakefile(const Batch& batch) {
    std::string names;
    for (const std::string& name : batch.names) names += fmt::format("    {},\n", inQuotes(name));
    return fmt::format(R"(# Rules of Snakemake for the cases of {0}:  snakemake -s {7}.smk -c 8
# Each case is a job of {3} core{8}; what is done is not run again, here or by caseSweep.
CASES = [
{1}]
STUDY, FOLDER = {5}, {6}

rule all:
    input:
        FOLDER + "/report.html"

rule one:
    output:
        touch(FOLDER + "/.finished/{{name}}")
    threads: {3}
    params:
        study=STUDY
    shell:
        {4} " {{params.study:q}} -only {{wildcards.name:q}} -ranks {3} -quiet"

rule collect:
    input:
        expand(FOLDER + "/.finished/{{name}}", name=CASES)
    output:
        FOLDER + "/report.html", FOLDER + "/summary.csv"
    params:
        study=STUDY
    shell:
        {4} " {{params.study:q}} -collect"
)",
                       batch.study, names, batch.names.size(), batch.ranks, inQuotes(forShell(batch.program)),
                       inQuotes(batch.study), inQuotes(batch.casesFolder), batch.name, batch.ranks == 1 ? "" : "s");
}

}  // namespace corpuscle::study
