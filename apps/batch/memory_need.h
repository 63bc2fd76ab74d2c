// Estimates the memory that a job takes, before it runs. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include "batch/jobs.h"

namespace relievo::app::batch {

// Estimates the most memory that the job takes, in megabytes, from its options and the headers of its files.
// The estimate uses the figures of docs/batch.md. Opens each file and reads its first 64 kB.
double memory_need_mb(const Job& job);

// Returns the memory that this process may still take, in megabytes: the machine's available memory or, if
// that is less, the rest of the limit of a control group, such as that of a container or of Slurm.
double available_memory_mb();

}  // namespace relievo::app::batch
