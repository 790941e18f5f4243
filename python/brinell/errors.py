"""Errors and warnings."""


class ContactError(RuntimeError):
    """An FMU has rejected a call; the text is that of the FMU."""


class UnknownName(ContactError, KeyError):
    """There is no such variable; the text lists the variables that exist."""

    # KeyError would show the text in quotation marks
    __str__ = RuntimeError.__str__


class ProgramError(RuntimeError):
    """The exporter is missing, or has rejected something; the text is that of the exporter."""


class ProgramWarning(UserWarning):
    """The exporter doubts a number, or warns that the law is not valid; the text is its own."""


class ContactWarning(UserWarning):
    """An FMU warns: its law is not valid where the contact is, its passivity guard acts, or it is
    coupled wrongly."""
