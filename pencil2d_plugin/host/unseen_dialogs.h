// Operates dialogs of the program without showing them.
#pragma once

#include <QDialog>
#include <QObject>
#include <QPointer>
#include <QStringList>

#include <functional>

namespace lampblack
{

/// While it exists, every dialog that the program opens is not shown and takes no focus and no input.
/// `answer` is called for it from the dialog's event loop. A dialog that is still open afterwards is
/// rejected, so that exec() always returns.
class UnseenDialogs : public QObject
{
    Q_OBJECT

public:
    using Answer = std::function<void(QDialog*)>;
    using Consent = std::function<bool(const QString& question)>;

    /// A message box is answered Yes if `consent` returns true for its text. Otherwise its text is a
    /// complaint.
    explicit UnseenDialogs(Answer answer, Consent consent = {});
    ~UnseenDialogs() override;

    /// Texts of the message boxes without consent: error messages of the program.
    QStringList complaints() const { return mComplaints; }

    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void answerTo(QDialog* dialog);

    Answer mAnswer;
    Consent mConsent;
    QStringList mComplaints;
    bool mNativeDialogs = true;
};

} // namespace lampblack
