// Dialogs that the program opens for us and that nobody is to see.
#pragma once

#include <QDialog>
#include <QObject>
#include <QPointer>
#include <QStringList>

#include <functional>

namespace lampblack
{

/// While it lives, every dialog that the program opens stays off the screen, takes no focus and no
/// input, and is answered by `answer` from within its own event loop. A dialog that is still open
/// after its answer is rejected, so that a nested exec() always returns.
class UnseenDialogs : public QObject
{
    Q_OBJECT

public:
    using Answer = std::function<void(QDialog*)>;
    using Consent = std::function<bool(const QString& question)>;

    /// Message boxes are complaints, but for questions that have our `consent`: they are answered Yes.
    explicit UnseenDialogs(Answer answer, Consent consent = {});
    ~UnseenDialogs() override;

    /// Texts of message boxes that came up: what the program complained about.
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
