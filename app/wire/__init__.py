"""What every question's words on the wire share: dragons, paths, times, answers, refusals."""
