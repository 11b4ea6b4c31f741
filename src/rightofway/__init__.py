"""Plans for fleets of mobile robots that go out, work and come home."""
