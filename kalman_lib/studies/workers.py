"""Who does the work of a study, this process or any executor, and what remains if it stops."""

import os
import signal
import traceback
import warnings
from collections.abc import Callable
from concurrent.futures import BrokenExecutor, CancelledError, Future, as_completed
from contextlib import suppress
from multiprocessing import parent_process
from threading import current_thread, main_thread

ROUNDS = 3  # how often an executor gets a block that fails


def do(tasks, done, executor=None):
    """Do every task whose number is not in `done`, and put its answer there.

    tasks    each (function, argument, ...)
    done     number of the task -> answer
    executor None: this process does them

    Whatever stops the work (Ctrl+C, an executor that breaks, tasks that fail), `done` keeps what
    has finished until then, and a line or a warning tells. Only where nothing at all has finished
    is the error raised.
    """
    crew = _Crew(tasks, done, executor)
    with _OneCtrlC() as ctrl_c:
        try:
            try:
                with _progress(len(tasks), len(done)) as bar:
                    crew.work(bar)
            finally:  # from here on Ctrl+C takes nothing away
                ctrl_c.hold()
        except KeyboardInterrupt:
            crew.stop()
            print(f"{len(done)} / {len(tasks)} (resume=...)")
        except Exception as error:
            crew.stop()
            if not done:
                raise
            _warn(*_broken(error, len(done), len(tasks)))
        else:
            if crew.failed and not done:
                raise next(iter(crew.failed.values()))
        if crew.failed:
            _warn(*_failed(crew.failed, len(done), len(tasks)))


class _Crew:
    """Those who do the tasks of one study.

    handed_out  future -> number of its task, of this round
    failed      number of the task -> its error, of this round
    """

    def __init__(self, tasks, done, executor):
        self.tasks, self.done, self.executor = tasks, done, executor
        self.handed_out, self.failed = {}, {}

    def work(self, bar):
        """Do what is left, and what fails once more: a worker may have died.

        The seed makes the numbers of a repeated block the same. If all fail, it is not the worker.
        """
        for _ in range(1 if self.executor is None else ROUNDS):
            self.handed_out, self.failed = {}, {}
            for number, future in self._finished():
                error = _error(future)
                if isinstance(error, (KeyboardInterrupt, BrokenExecutor)):
                    raise error
                if error is None:
                    self.done[number] = future.result()
                    bar.update()
                else:
                    self.failed[number] = error
            if not self.failed or not self.done:
                break

    def _finished(self):
        """Number and future of every task that is left, each as soon as it has finished."""
        left = [number for number in range(len(self.tasks)) if number not in self.done]
        if self.executor is None:
            for number in left:
                yield number, _settled(*self.tasks[number])
            return
        for number in left:
            self.handed_out[self._submit(number)] = number
        for future in as_completed(self.handed_out):
            yield self.handed_out[future], future

    def _submit(self, number):
        """The future of a task. An executor that refuses it has failed in it."""
        try:
            return self.executor.submit(_in_a_worker, *self.tasks[number])
        except Exception as error:
            future = Future()
            future.set_exception(error)
            return future

    def stop(self):
        """Cancel what has not begun, keep what has finished.

        A pool that breaks just now gives every future an error. In Python 3.11 it stumbles over
        those that are cancelled and never ends its processes: so they take no error any more.
        """
        for future, number in self.handed_out.items():
            if not future.done():
                future.set_exception = _ignore
            if not future.cancel() and future.done() and _error(future) is None:
                self.done[number] = future.result()


def _settled(function, *arguments):
    """A future whose task has been done here and now."""
    future = Future()
    try:
        future.set_result(function(*arguments))
    except Exception as error:
        traceback.clear_frames(error.__traceback__)  # the arrays of a block that failed
        future.set_exception(error)
    return future


def _ignore(error):
    pass


def _error(future):
    """What the task of a finished future failed with, or None."""
    try:
        return future.exception()
    except CancelledError as error:
        return error


# --- Ctrl+C --------------------------------------------------------------------------------------


class _OneCtrlC:
    """Lets one Ctrl+C through, and none after hold(): pressing twice costs nothing of the study.

    Where Ctrl+C does not come (outside the main thread), or has another meaning, nothing changes.
    """

    def __enter__(self):
        self.held, self.process = False, os.getpid()
        self.before = signal.getsignal(signal.SIGINT)
        self._set(self._pressed)
        return self

    def hold(self):
        self.held = True

    def __exit__(self, *error):
        with suppress(KeyboardInterrupt):  # pressed while the old meaning comes back
            self._set(self.before)

    def _set(self, handler):
        if callable(self.before):
            with suppress(ValueError):  # not the main thread
                signal.signal(signal.SIGINT, handler)

    def _pressed(self, *arguments):
        if self.held or os.getpid() != self.process:  # a worker may be a copy of this one
            return
        try:
            self.before(*arguments)
        except KeyboardInterrupt:
            self.held = True
            raise


def _in_a_worker(function, *arguments):
    """Do a task that was given to an executor.

    Ctrl+C in a terminal, and the interrupt of Jupyter, reach the processes of a pool, too. There
    it may end a block, but no process that waits for one or sends its answer: the pool would
    break, or wait for ever.
    """
    if parent_process() is None or current_thread() is not main_thread():
        return function(*arguments)
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        return function(*arguments)
    finally:
        signal.signal(signal.SIGINT, signal.SIG_IGN)


# --- what is told --------------------------------------------------------------------------------


def _broken(error, done, total):
    """Two sentences, en and id, on an executor that broke."""
    en, id = _words(error)
    return (
        f"A process of the executor died, or the executor failed otherwise ({en}); {done} of "
        f"{total} blocks are finished: go on with resume= and another executor.",
        f"Satu proses eksekutor mati, atau eksekutornya gagal karena hal lain ({id}); {done} "
        f"dari {total} blok selesai: lanjutkan dengan resume= dan eksekutor lain.",
    )


def _failed(errors, done, total):
    """Two sentences, en and id, on tasks that failed; errors: number -> error."""
    numbers = sorted(errors)
    first = numbers[0]
    en, id = _words(errors[first])
    names = ", ".join(str(number) for number in numbers[:10])
    if len(numbers) > 10:
        names += ", ..."
    return (
        f"Blocks that failed: {names} ({first}: {en}); {done} of {total} are finished, and "
        "resume= tries the failed ones again.",
        f"Blok yang gagal: {names} ({first}: {id}); {done} dari {total} selesai, dan resume= "
        "mencoba lagi yang gagal.",
    )


def _words(error):
    """The name of an error and what it says, en and id: our own errors say it in both."""
    en, _, id = str(error).partition(" / ")
    kind = type(error).__name__
    return [f"{kind}: {' '.join(words.split())}" if words else kind for words in (en, id or en)]


def _warn(en, id):
    """A warning that points at the reader's line: above this function, do and monte_carlo."""
    warnings.warn(f"{en} / {id}", stacklevel=4)


def _progress(total, initial):
    """A progress bar for what takes longer than a second; TQDM_DISABLE in the environment: none.

    There is none without tqdm either, nor where a Ctrl+C has left it half imported.
    """
    try:
        from tqdm.auto import tqdm
    except Exception:
        return _Silent()
    disable = bool(os.environ.get("TQDM_DISABLE"))
    return tqdm(total=total, initial=initial, delay=1, leave=False, disable=disable)


class _Silent:
    update: Callable = staticmethod(lambda: None)

    def __enter__(self):
        return self

    def __exit__(self, *error):
        return False
