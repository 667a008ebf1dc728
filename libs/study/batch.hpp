// Files by which other programs run the cases of a study: a job array of SLURM, rules of Snakemake. Both call caseSweep
// for one case at a time, so that what is done is not done again, whichever way it was run.
#pragma once
#include <string>
#include <vector>

namespace corpuscle::study {

struct Batch {
    std::string name;                     // of the study; the files are NAME.slurm and NAME.smk
    std::string study;                    // study.yaml, from the folder in which the file is used
    std::string program;                  // caseSweep, as it is called
    std::string casesFolder;              // from the same folder
    std::vector<std::string> names = {};  // of the cases
    long ranks = 1;
};

std::string slurmScript(const Batch& batch);
std::string snakefile(const Batch& batch);

}  // namespace corpuscle::study
