// Files with which other programs run the cases of a study: a SLURM job array and Snakemake rules. Both call caseSweep
// for one case at a time, so that a case that is done is not run again, whichever way it was run.
#pragma once
#include <string>
#include <vector>

namespace corpuscle::study {

struct Batch {
    std::string name;                     // of the study; the files are NAME.slurm and NAME.smk
    std::string study;                    // path of study.yaml, relative to the folder in which the file is used
    std::string program;                  // caseSweep: its name or path
    std::string casesFolder;              // relative to the same folder
    std::vector<std::string> names = {};  // of the cases
    long ranks = 1;
};

std::string slurmScript(const Batch& batch);
std::string snakefile(const Batch& batch);

}  // namespace corpuscle::study
