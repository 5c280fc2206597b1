from threadpoolctl import threadpool_info

from exu_press.numerics.threads import one_thread


def test_linear_algebra_has_one_thread_and_then_its_own_again():
    def threads():
        return [library["num_threads"] for library in threadpool_info()]

    before = threads()
    with one_thread():
        assert set(threads()) == {1}
    assert threads() == before
