// The memory that a job takes, known before it runs. Tested by tests/cli/batch_jobs_test.cpp.
#pragma once

#include "batch/jobs.h"

namespace relievo::app::batch {

// Returns about the most memory that the job takes, in megabytes, from the headers of its files and its options. The
// figures are those of docs/batch.md. It opens each file and reads 64 kB of it.
double memory_need_mb(const Job& job);

// Returns the memory that this process may still take, in megabytes: the machine's available memory or, if
// that is less, what control groups leave, such as those of a container or of Slurm.
double available_memory_mb();

}  // namespace relievo::app::batch
