"""Whether fits recover the keys that synthetic measurements were made with."""
