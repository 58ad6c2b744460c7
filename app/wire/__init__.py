"""Parts that all requests and answers share: dragons, paths, times, answers, refusals."""
