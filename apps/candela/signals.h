// What happens when the system or a person ends the command.
#pragma once

/// From here on, SIGINT, SIGTERM, SIGHUP and SIGPIPE end the process as ever, but leave no unfinished file
/// and no temporary folder behind; a file that grows beyond its limit (RLIMIT_FSIZE) is an error like a full
/// disk. To be called first in main().
void prepare_for_signals();
