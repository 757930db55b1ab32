#include "host/unseen_dialogs.h"

#include <QAbstractButton>
#include <QCoreApplication>
#include <QEvent>
#include <QFileDialog>
#include <QMessageBox>
#include <QProgressDialog>
#include <QTimer>

namespace lampblack
{

UnseenDialogs::UnseenDialogs(Answer answer, Consent consent)
    : mAnswer(std::move(answer)), mConsent(std::move(consent))
{
    mNativeDialogs = !QCoreApplication::testAttribute(Qt::AA_DontUseNativeDialogs);
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs, true);
    QCoreApplication::instance()->installEventFilter(this);
}

UnseenDialogs::~UnseenDialogs()
{
    QCoreApplication::instance()->removeEventFilter(this);
    QCoreApplication::setAttribute(Qt::AA_DontUseNativeDialogs, !mNativeDialogs);
}

bool UnseenDialogs::eventFilter(QObject* watched, QEvent* event)
{
    if (event->type() != QEvent::Polish && event->type() != QEvent::Show)
        return false;
    auto* dialog = qobject_cast<QDialog*>(watched);
    if (dialog == nullptr)
        return false;

    dialog->setAttribute(Qt::WA_DontShowOnScreen);
    if (event->type() == QEvent::Polish)
    {
        // A modal dialog would block strokes that the artist draws meanwhile, even if it is not shown.
        if (qobject_cast<QFileDialog*>(dialog) == nullptr)
            dialog->setWindowModality(Qt::NonModal);
        return false;
    }
    // Later, because during Show exec() is not waiting yet, and would never return.
    QTimer::singleShot(0, dialog,
                       [self = QPointer<UnseenDialogs>(this), dialog]
                       {
                           if (self != nullptr)
                               self->answerTo(dialog);
                       });
    return false;
}

void UnseenDialogs::answerTo(QDialog* dialog)
{
    if (qobject_cast<QProgressDialog*>(dialog) != nullptr)
        return;
    const QPointer<QDialog> guard(dialog);
    if (auto* box = qobject_cast<QMessageBox*>(dialog))
    {
        QAbstractButton* yes = box->button(QMessageBox::Yes);
        if (yes == nullptr)
            yes = box->button(QMessageBox::Ok);
        if (yes != nullptr && mConsent && mConsent(box->text()))
            yes->click();
        else
            mComplaints.append(box->text());
    }
    else
        mAnswer(dialog);
    if (guard != nullptr && guard->isVisible())
        guard->reject();
}

} // namespace lampblack
