"""Measures how long programs take."""
import resource
import time


def processor_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def seconds(work):
    """The clock time of `work`, and the processor time of the programs that it waits for."""
    begin, begin_processor = time.perf_counter(), processor_seconds()
    work()
    return time.perf_counter() - begin, processor_seconds() - begin_processor
