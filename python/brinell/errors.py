"""What can go wrong."""


class ContactError(RuntimeError):
    """A unit has refused something; the text has what the unit itself says."""


class UnknownName(ContactError, KeyError):
    """There is no such variable; the text lists those that there are."""

    # KeyError would show the text in quotation marks
    __str__ = RuntimeError.__str__


class ProgramError(RuntimeError):
    """The exporter isn't there, or has refused something; the text has what it says."""


class ContactWarning(UserWarning):
    """A unit tells that its law isn't valid where the contact is, or that its passivity guard
    acts."""
