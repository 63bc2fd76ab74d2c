// Estimates, before a job runs, how much memory it will take. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include "batch/jobs.h"

namespace relievo::app::batch {

// Estimates the job's peak memory, in megabytes, from its options and the headers of its files, with the
// figures of docs/batch.md. Opens each file and reads its first 64 kB.
double memory_need_mb(const Job& job);

// Returns the memory, in MB, that this process may still allocate. This is the available memory of the
// machine, or the unused part of the limit of the process's control group, whichever is less. Containers and
// Slurm set such limits.
double available_memory_mb();

}  // namespace relievo::app::batch
