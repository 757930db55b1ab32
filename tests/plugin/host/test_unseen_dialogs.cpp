// Dialogs are answered without being shown.
#include "host/unseen_dialogs.h"

#include <QApplication>
#include <QInputDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QTest>
#include <QTimer>

using namespace lampblack;

class UnseenDialogsTest : public QObject
{
    Q_OBJECT

private Q_SLOTS:
    void modalDialogIsAnswered()
    {
        bool shown = true;
        bool modal = true;
        QString name;
        {
            const UnseenDialogs unseen(
                [&](QDialog* dialog)
                {
                    shown = !dialog->testAttribute(Qt::WA_DontShowOnScreen);
                    modal = dialog->isModal();
                    qobject_cast<QInputDialog*>(dialog)->setTextValue(QStringLiteral("ours"));
                    dialog->accept();
                });
            name = QInputDialog::getText(nullptr, QStringLiteral("Layer"), QStringLiteral("Name"));
        }
        QCOMPARE(name, QStringLiteral("ours"));
        QVERIFY(!shown && !modal);
    }

    void dialogThatStaysIsRejected()
    {
        QDialog stubborn;
        const UnseenDialogs unseen([](QDialog*) {});
        QCOMPARE(stubborn.exec(), int(QDialog::Rejected));
    }

    void dialogMayDieInItsAnswer()
    {
        const UnseenDialogs unseen([](QDialog* dialog) { delete dialog; });
        auto* dialog = new QDialog;
        dialog->show();
        const QPointer<QDialog> guard(dialog);
        QTRY_VERIFY(guard == nullptr);
    }

    void complaintsAreKept()
    {
        const UnseenDialogs unseen([](QDialog*) { QFAIL("a message is not ours to answer"); });
        QMessageBox::warning(nullptr, QString(), QStringLiteral("Unable to export image."));
        QCOMPARE(unseen.complaints(), QStringList(QStringLiteral("Unable to export image.")));
    }

    void strokesGoOnBeneath()
    {
        QLineEdit below;
        below.show();
        QVERIFY(QTest::qWaitForWindowExposed(&below));
        below.setFocus();
        const UnseenDialogs unseen(
            [&](QDialog* dialog)
            {
                QTest::keyClicks(&below, QStringLiteral("abc"));
                dialog->accept();
            });
        QDialog dialog;
        dialog.setModal(true);
        dialog.exec();
        QCOMPARE(below.text(), QStringLiteral("abc"));
    }

    void laterDialogsAreTheArtists()
    {
        const bool native = !QCoreApplication::testAttribute(Qt::AA_DontUseNativeDialogs);
        {
            const UnseenDialogs unseen([](QDialog*) {});
        }
        QCOMPARE(!QCoreApplication::testAttribute(Qt::AA_DontUseNativeDialogs), native);
        QDialog dialog;
        dialog.show();
        QVERIFY(!dialog.testAttribute(Qt::WA_DontShowOnScreen));
    }
};

QTEST_MAIN(UnseenDialogsTest)
#include "test_unseen_dialogs.moc"
