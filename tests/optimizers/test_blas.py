"""Linear algebra on one thread, and as before when that is over."""

from threadpoolctl import threadpool_info, threadpool_limits

from levade.optimizers.blas import single_threaded


def _threads() -> set[int]:
    """Of numpy's libraries: scipy brings its own, if another test has loaded scikit-learn."""
    own = [one for one in threadpool_info() if one["user_api"] == "blas" and "scipy.libs" not in one["filepath"]]
    return {library["num_threads"] for library in own}


def test_contexts_within_each_other_end_with_the_outermost():
    with threadpool_limits(limits=2, user_api="blas"):
        with single_threaded():
            with single_threaded():
                assert _threads() == {1}
            assert _threads() == {1}
        assert _threads() == {2}


def test_an_error_gives_the_threads_back():
    with threadpool_limits(limits=2, user_api="blas"):
        try:
            with single_threaded():
                raise ValueError
        except ValueError:
            pass
        assert _threads() == {2}
